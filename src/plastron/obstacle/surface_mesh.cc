// Marching tetrahedra: each cell of a grid is cut into six, and the surface crosses a tetrahedron in one or two
// triangles.
#include <plastron/obstacle/surface_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace plastron::obstacle {

namespace {

using Levels = std::function<std::vector<double>(std::span<const Vector3d>)>;

/// Values of a function that is zero on the surface and positive on the free side. It need not be a distance; NaN where
/// it is undefined.
template <class Body>
std::vector<double> levels_of(const Body& body, std::span<const Vector3d> places) {
  if constexpr (requires { body.levels(places); }) {
    return body.levels(places);
  } else {
    std::vector<double> all;
    for (const Vector3d& x : places)
      if constexpr (requires { body.level(x); })
        all.push_back(body.level(x));
      else
        all.push_back(body.nearest(x).distance);
    return all;
  }
}

/// The axis-parallel box in the body's coordinates around an extent in space.
Extent in_body(const Extent& extent, const Placement& placement) {
  const Vector3d middle = placement.to_body((extent.low + extent.high) / 2);
  const Vector3d half = placement.rotation.transpose().cwiseAbs() * (extent.high - extent.low) / 2;
  return {middle - half, middle + half};
}

class Marching {
 public:
  Marching(const Levels& levels, const Extent& extent, int intervals)
      : levels_(levels), low_(extent.low), step_((extent.high - extent.low) / intervals), n_(intervals + 1) {}

  TriangleMesh surface() {
    std::vector<Vector3d> corners;
    corners.reserve(static_cast<std::size_t>(n_ * n_ * n_));
    for (int i = 0; i < n_ * n_ * n_; ++i) corners.push_back(point(i));
    values_ = levels_(corners);
    for (int k = 0; k + 1 < n_; ++k)
      for (int j = 0; j + 1 < n_; ++j)
        for (int i = 0; i + 1 < n_; ++i) cell(i + n_ * (j + n_ * k));
    find_crossings();
    orient();
    return std::move(mesh_);
  }

 private:
  /// An edge of the grid from a corner outside of the body to one inside.
  struct Edge {
    int free, held;
  };

  Vector3d point(int i) const {
    const Eigen::Vector3i at(i % n_, (i / n_) % n_, i / (n_ * n_));
    return low_ + step_.cwiseProduct(at.cast<double>());
  }

  /// Visits six tetrahedra around the diagonal of the cell, one for each order of the axes.
  void cell(int first) {
    const std::array<int, 3> along{1, n_, n_ * n_};
    std::array<int, 3> order{0, 1, 2};
    do {
      const int a = first, b = a + along[order[0]], c = b + along[order[1]], d = c + along[order[2]];
      tetrahedron({a, b, c, d});
    } while (std::ranges::next_permutation(order).found);
  }

  void tetrahedron(const std::array<int, 4>& corners) {
    std::vector<int> free, held;
    for (const int c : corners) {
      if (std::isnan(values_[c])) return;
      (values_[c] > 0 ? free : held).push_back(c);
    }
    if (free.empty() || held.empty()) return;
    if (free.size() == 2) {
      const int p = crossing(free[0], held[0]), q = crossing(free[0], held[1]), r = crossing(free[1], held[1]),
                s = crossing(free[1], held[0]);
      add({p, q, r}, free[0], held[0]);
      add({p, r, s}, free[0], held[0]);
    } else {
      const bool one_free = free.size() == 1;
      const int apex = one_free ? free[0] : held[0];
      const auto& others = one_free ? held : free;
      add({crossing(apex, others[0]), crossing(apex, others[1]), crossing(apex, others[2])}, free[0], held[0]);
    }
  }

  void add(const std::array<int, 3>& t, int free, int held) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    mesh_.triangles.push_back(t);
    across_.push_back({free, held});
  }

  /// Turns the triangles so that their normals point from the corner `held` inside the body to the corner `free`.
  void orient() {
    const auto& p = mesh_.points;
    for (std::size_t k = 0; k < across_.size(); ++k) {
      auto& t = mesh_.triangles[k];
      const Vector3d normal = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
      if (normal.dot(point(across_[k].free) - point(across_[k].held)) < 0) std::swap(t[1], t[2]);
    }
  }

  /// Returns the number of the point between two corners where the level is zero.
  int crossing(int a, int b) {
    const auto [found, is_new] = crossings_.try_emplace(std::minmax(a, b), static_cast<int>(edges_.size()));
    if (is_new) edges_.push_back(values_[a] > 0 ? Edge{a, b} : Edge{b, a});
    return found->second;
  }

  /// Finds the zeros of the level on all edges, by bisection.
  void find_crossings() {
    std::vector<Vector3d> free, held, middle(edges_.size());
    for (const Edge& edge : edges_) {
      free.push_back(point(edge.free));
      held.push_back(point(edge.held));
    }
    constexpr int halvings = 30;
    for (int i = 0; i <= halvings; ++i) {
      for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = (free[k] + held[k]) / 2;
      if (i == halvings) break;
      const std::vector<double> values = levels_(middle);
      for (std::size_t k = 0; k < middle.size(); ++k) (values[k] > 0 ? free : held)[k] = middle[k];
    }
    mesh_.points = std::move(middle);
  }

  const Levels& levels_;
  Vector3d low_, step_;
  int n_;
  std::vector<double> values_;
  std::map<std::pair<int, int>, int> crossings_;
  std::vector<Edge> edges_;
  std::vector<Edge> across_;  ///< of the triangles
  TriangleMesh mesh_;
};

/// The plane's rectangle around the foot of the box's middle, large enough for the whole box.
TriangleMesh rectangle(const HalfSpace& body, const Extent& extent) {
  const Vector3d middle = (extent.low + extent.high) / 2;
  const double reach = (extent.high - extent.low).norm() / 2, distance = body.nearest(middle).distance;
  if (std::abs(distance) > reach) return {};
  const Vector3d foot = middle - distance * body.normal, u = body.normal.unitOrthogonal(), v = body.normal.cross(u);
  return {{foot - reach * u - reach * v, foot + reach * u - reach * v, foot + reach * u + reach * v,
           foot - reach * u + reach * v},
          {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh marched(const Shape& shape, Extent extent, int intervals) {
  if (const auto reach = std::visit([](const auto& body) { return body.extent(); }, shape)) {
    extent = {extent.low.cwiseMax(reach->low), extent.high.cwiseMin(reach->high)};
    if ((extent.low.array() >= extent.high.array()).any()) return {};
  }
  const Levels levels = [&](std::span<const Vector3d> places) {
    return std::visit([&](const auto& body) { return levels_of(body, places); }, shape);
  };
  return Marching(levels, extent, intervals).surface();
}

/// Removes triangles with their middle outside of the extent.
void cut(TriangleMesh& mesh, const Extent& extent) {
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    const Vector3d middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3;
    return (middle.array() < extent.low.array()).any() || (middle.array() > extent.high.array()).any();
  });
}

}  // namespace

TriangleMesh surface_mesh(const Obstacle& obstacle, const Extent& extent, int intervals) {
  const Placement& now = obstacle.placement;
  const Extent of_body = in_body(extent, now);
  const auto* plane = std::get_if<HalfSpace>(&obstacle.shape);
  const auto* surface = std::get_if<TriangleSurface>(&obstacle.shape);
  TriangleMesh mesh = plane     ? rectangle(*plane, of_body)
                      : surface ? surface->mesh()
                                : marched(obstacle.shape, of_body, intervals);
  for (Vector3d& p : mesh.points) p = now.to_space(p);
  if (!plane) cut(mesh, extent);
  return mesh;
}

}  // namespace plastron::obstacle
