// Search for a vertex in the interior of a side. It examines only the boundary edges: a side that no neighbour shares
// completely belongs to one cell.
#include <plastron/fem/mesh_validity.hpp>

#include <algorithm>

namespace plastron::fem {

namespace {

/// Vertices on the boundary, in ascending order of one coordinate.
std::vector<int> sorted_along(int axis, const CoarseMesh& mesh, const std::vector<MeshEdge>& boundary) {
  std::vector<int> vertices;
  for (const MeshEdge& e : boundary) vertices.insert(vertices.end(), e.ends.begin(), e.ends.end());
  const auto key = [&](int v) { return std::pair(mesh.vertices[static_cast<std::size_t>(v)][axis], v); };
  std::ranges::sort(vertices, {}, key);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The side of a cell as a curve over [0, 1].
struct SideCurve {
  const CoarseCell& cell;
  int side;

  Vector2d at(double t) const { return cell.map(side_point(shape_of(cell), side, t)).value; }
  Vector2d derivative(double t) const {
    const Shape shape = shape_of(cell);
    const PlaneJet f = cell.map(side_point(shape, side, t));
    const Vector2d along = side_point(shape, side, 1) - side_point(shape, side, 0);
    return along[0] * f.d[0] + along[1] * f.d[1];
  }
};

/// Whether the curve passes through the point away from its ends. Lengths are relative to its chord.
bool passes_through(const SideCurve& curve, const Vector2d& point) {
  constexpr double tolerance = 1e-6;
  const Vector2d from = curve.at(0), chord = curve.at(1) - from;
  double t = (point - from).dot(chord) / chord.squaredNorm();
  for (int step = 0; step < 10; ++step) {
    if (!(t > -0.5 && t < 1.5)) return false;
    const Vector2d d = curve.derivative(t);
    const double change = (point - curve.at(t)).dot(d) / d.squaredNorm();
    t += change;
    if (std::abs(change) < 1e-12) break;
  }
  return t > tolerance && t < 1 - tolerance && (point - curve.at(t)).norm() < tolerance * chord.norm();
}

/// A box round a side, wide enough for a curved side.
std::pair<Vector2d, Vector2d> box_round(const SideCurve& curve) {
  Vector2d low = curve.at(0), high = low;
  for (const double t : {0.25, 0.5, 0.75, 1.0}) {
    low = low.cwiseMin(curve.at(t));
    high = high.cwiseMax(curve.at(t));
  }
  const double margin = 0.1 * (high - low).norm();
  return {low.array() - margin, high.array() + margin};
}

}  // namespace

std::optional<HangingVertex> find_hanging_vertex(const CoarseMesh& mesh, const std::vector<MeshEdge>& boundary) {
  const std::vector<int> sorted[2] = {sorted_along(0, mesh, boundary), sorted_along(1, mesh, boundary)};
  for (const MeshEdge& edge : boundary) {
    const SideCurve curve{mesh.cells[edge.cell], edge.side};
    const auto [low, high] = box_round(curve);
    std::span<const int> near[2];
    for (int axis = 0; axis < 2; ++axis) {
      const auto key = [&](int v) { return mesh.vertices[static_cast<std::size_t>(v)][axis]; };
      const auto first = std::ranges::lower_bound(sorted[axis], low[axis], {}, key);
      near[axis] = {first, std::ranges::upper_bound(first, sorted[axis].end(), high[axis], {}, key)};
    }
    for (const int v : near[near[0].size() < near[1].size() ? 0 : 1]) {
      const Vector2d& p = mesh.vertices[static_cast<std::size_t>(v)];
      if (v == edge.ends[0] || v == edge.ends[1] || (p.array() < low.array()).any() || (p.array() > high.array()).any())
        continue;
      if (passes_through(curve, p)) return HangingVertex{v, edge};
    }
  }
  return {};
}

}  // namespace plastron::fem
