#include <plastron/domain/mesh_validity.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace plastron::domain {

namespace {

/// A vertex in the interior of a side.
struct HangingVertex {
  int vertex;
  mesh::MeshEdge edge;
};

/// Vertices on the boundary, in ascending order of one coordinate.
std::vector<int> sorted_along(int axis, const mesh::CoarseMesh& mesh, const std::vector<mesh::MeshEdge>& boundary) {
  std::vector<int> vertices;
  for (const mesh::MeshEdge& e : boundary) vertices.insert(vertices.end(), e.ends.begin(), e.ends.end());
  const auto key = [&](int v) { return std::pair(mesh.vertices[v][axis], v); };
  std::ranges::sort(vertices, {}, key);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The side of a cell as a curve over [0, 1].
struct SideCurve {
  const mesh::CoarseCell& cell;
  int side;

  Vector2d at(double t) const { return cell.map(mesh::side_point(mesh::shape_of(cell), side, t)).value; }
  Vector2d derivative(double t) const {
    const mesh::Shape shape = mesh::shape_of(cell);
    const geometry::PlaneJet f = cell.map(mesh::side_point(shape, side, t));
    const Vector2d along = mesh::side_point(shape, side, 1) - mesh::side_point(shape, side, 0);
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

/// Searches for a vertex in the interior of a side. `boundary` contains the edges that belong to only one cell: a side
/// that no neighbour shares completely is one of them.
std::optional<HangingVertex> find_hanging_vertex(const mesh::CoarseMesh& mesh,
                                                 const std::vector<mesh::MeshEdge>& boundary) {
  const std::vector<int> sorted[2] = {sorted_along(0, mesh, boundary), sorted_along(1, mesh, boundary)};
  for (const mesh::MeshEdge& edge : boundary) {
    const SideCurve curve{mesh.cells[edge.cell], edge.side};
    const auto [low, high] = box_round(curve);
    std::span<const int> near[2];
    for (int axis = 0; axis < 2; ++axis) {
      const auto key = [&](int v) { return mesh.vertices[v][axis]; };
      const auto first = std::ranges::lower_bound(sorted[axis], low[axis], {}, key);
      near[axis] = {first, std::ranges::upper_bound(first, sorted[axis].end(), high[axis], {}, key)};
    }
    for (const int v : near[near[0].size() < near[1].size() ? 0 : 1]) {
      const Vector2d& p = mesh.vertices[v];
      if (v == edge.ends[0] || v == edge.ends[1] || (p.array() < low.array()).any() || (p.array() > high.array()).any())
        continue;
      if (passes_through(curve, p)) return HangingVertex{v, edge};
    }
  }
  return {};
}

class Examiner {
 public:
  Examiner(const FileCells& cells, const std::vector<mesh::MeshEdge>& edges, const std::string& source)
      : cells_(cells), edges_(edges), source_(source) {}

  void run() const {
    cells_differ();
    std::vector<mesh::MeshEdge> boundary;
    for (std::size_t i = 0; i < edges_.size();) {
      std::size_t end = i + 1;
      while (end < edges_.size() && edges_[end].ends == edges_[i].ends) ++end;
      join(std::span(edges_).subspan(i, end - i));
      if (end == i + 1) boundary.push_back(edges_[i]);
      i = end;
    }
    if (const auto hanging = find_hanging_vertex(cells_.mesh, boundary)) refuse_hanging(*hanging);
    if (const auto pair = mesh::find_overlap(cells_.mesh))
      refuse(fmt::format("{} and {} overlap near {}; cells must lie side by side", element((*pair)[0]),
                         element((*pair)[1]), place(centre_of((*pair)[0]))));
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw mesh::DomainError(source_ + ": " + what); }
  std::string element(std::size_t cell) const { return place_of(*cells_.elements[cell]); }
  static std::string place(const Vector2d& x) { return fmt::format("({:.6g}, {:.6g})", x[0], x[1]); }
  const Vector2d& vertex(int v) const { return cells_.mesh.vertices[v]; }
  Vector2d centre_of(std::size_t cell) const {
    const mesh::CoarseCell& c = cells_.mesh.cells[cell];
    return c.map(mesh::centre(mesh::shape_of(c))).value;
  }

  void cells_differ() const {
    std::vector<std::pair<std::array<int, 4>, std::size_t>> corners;
    for (std::size_t c = 0; c < cells_.mesh.cells.size(); ++c) {
      auto v = cells_.mesh.cells[c].vertices;
      std::ranges::sort(v);
      corners.emplace_back(v, c);
    }
    std::ranges::sort(corners);
    const auto twice =
        std::ranges::adjacent_find(corners, [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != corners.end())
      refuse(fmt::format("{} and {} are the same cell, at {}; it must stand once, in one physical surface",
                         element(twice->second), element(std::next(twice)->second), place(centre_of(twice->second))));
  }

  /// All cells are anticlockwise, so neighbours run along their common side in opposite directions.
  void join(std::span<const mesh::MeshEdge> same) const {
    const Vector2d &a = vertex(same[0].ends[0]), &b = vertex(same[0].ends[1]);
    if (same.size() > 2)
      refuse(fmt::format("{} cells meet at the side from {} to {}: {}, {}, {}; two are most", same.size(), place(a),
                         place(b), element(same[0].cell), element(same[1].cell), element(same[2].cell)));
    if (same.size() == 2 && same[0].is_forward == same[1].is_forward)
      refuse(fmt::format("{} and {} lie on the same side of their common side from {} to {}: they overlap",
                         element(same[0].cell), element(same[1].cell), place(a), place(b)));
  }

  [[noreturn]] void refuse_hanging(const HangingVertex& h) const {
    refuse(fmt::format(
        "a corner at {} lies inside of the side from {} to {} of {}: a hanging node, where the mesh is not "
        "joined; neighbouring cells must share whole sides",
        place(vertex(h.vertex)), place(vertex(h.edge.ends[0])), place(vertex(h.edge.ends[1])), element(h.edge.cell)));
  }

  const FileCells& cells_;
  const std::vector<mesh::MeshEdge>& edges_;
  const std::string& source_;
};

}  // namespace

mesh::LatticeTable jacobian_table(mesh::Shape shape, int order) {
  // For degree one the determinant is linear and has its extremes at the corners.
  return mesh::lattice_table(shape, order, mesh::lattice(shape, order == 1 ? 1 : 4 * order));
}

JacobianRange jacobian_range(const mesh::LatticeTable& table, const std::vector<Vector2d>& nodes) {
  constexpr double degenerate = 1e-9;  // sine of the angle between the cell's two directions
  Eigen::MatrixX2d x(static_cast<Eigen::Index>(nodes.size()), 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) x.row(static_cast<Eigen::Index>(i)) = nodes[i] - nodes.front();
  const Eigen::MatrixX2d d1 = table.d1 * x, d2 = table.d2 * x;
  JacobianRange range;
  double sum = 0;
  Eigen::VectorXd sine(d1.rows());
  for (Eigen::Index p = 0; p < d1.rows(); ++p) {
    const double lengths = d1.row(p).norm() * d2.row(p).norm();
    sine[p] = lengths > 0 ? (d1(p, 0) * d2(p, 1) - d1(p, 1) * d2(p, 0)) / lengths : 0;
    sum += sine[p];
    range.is_positive = range.is_positive && sine[p] > degenerate;
    range.is_negative = range.is_negative && sine[p] < -degenerate;
  }
  Eigen::Index worst = 0;
  (sum < 0 ? Eigen::VectorXd(-sine) : sine).minCoeff(&worst);
  range.worst = nodes.front() + (table.value.row(worst) * x).transpose();
  return range;
}

void check_cells_fit(const FileCells& cells, const std::vector<mesh::MeshEdge>& edges, const std::string& source) {
  Examiner(cells, edges, source).run();
}

}  // namespace plastron::domain
