#include <plastron/fem/subdivided_mesh.hpp>

#include <plastron/algebra/assertion.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace plastron::fem {

namespace {

class Subdivision {
 public:
  explicit Subdivision(const CoarseMesh& whole) : whole_(whole) {
    mesh_.shape = whole.shape;
    mesh_.vertices = whole.vertices;
    mesh_.regions = whole.regions;
    mesh_.boundaries = whole.boundaries;
  }

  void add(const CoarseCell& cell, const Cuts& cuts) {
    const auto columns = static_cast<int>(cuts[0].size()) + 1, rows = static_cast<int>(cuts[1].size()) + 1;
    const auto place = [&](int i, int j) { return Vector2d(place_of(cuts[0], i), place_of(cuts[1], j)); };
    std::vector<int> lattice(static_cast<std::size_t>((columns + 1) * (rows + 1)), -1);
    const auto at = [&](int i, int j) -> int& { return lattice[static_cast<std::size_t>(j * (columns + 1) + i)]; };
    for (const int j : {0, rows}) {
      const auto side = side_vertices(cell, j == 0 ? std::array{0, 1} : std::array{2, 3}, cuts[0]);
      for (int i = 0; i <= columns; ++i) at(i, j) = side[static_cast<std::size_t>(i)];
    }
    for (const int i : {0, columns}) {
      const auto side = side_vertices(cell, i == 0 ? std::array{0, 2} : std::array{1, 3}, cuts[1]);
      for (int j = 0; j <= rows; ++j) at(i, j) = side[static_cast<std::size_t>(j)];
    }
    for (int j = 1; j < rows; ++j)
      for (int i = 1; i < columns; ++i) at(i, j) = add_vertex(cell.map(place(i, j)).value);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const Vector2d from = place(i, j), size = place(i + 1, j + 1) - from;
        const CellMap map{cell.map.map, cell.map.origin + cell.map.axes * from, cell.map.axes * size.asDiagonal()};
        mesh_.cells.push_back({{at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}, cell.region, map});
      }
  }

  CoarseMesh finished() {
    for (const BoundaryEdge& edge : whole_.edges) {
      const std::vector<int> line = drawn_from(edge.vertices[0], edge.vertices[1]);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) mesh_.edges.push_back({{line[i], line[i + 1]}, edge.boundary});
    }
    return std::move(mesh_);
  }

 private:
  /// Place of line i: 0, the cuts, 1.
  static double place_of(const std::vector<double>& cuts, int i) {
    if (i == 0) return 0;
    return i > static_cast<int>(cuts.size()) ? 1 : cuts[static_cast<std::size_t>(i - 1)];
  }

  int add_vertex(const Vector2d& position) {
    mesh_.vertices.push_back(position);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  /// Vertices from the first of two corners of a cell to the second.
  std::vector<int> side_vertices(const CoarseCell& cell, const std::array<int, 2>& corners,
                                 const std::vector<double>& cuts) {
    const int from = cell.vertices[static_cast<std::size_t>(corners[0])],
              to = cell.vertices[static_cast<std::size_t>(corners[1])];
    auto& line = sides_[std::minmax(from, to)];
    if (line.empty()) {
      const Vector2d a = corner(Shape::quadrilateral, corners[0]), b = corner(Shape::quadrilateral, corners[1]);
      line.push_back(from);
      for (const double at : cuts) line.push_back(add_vertex(cell.map(a + (b - a) * at).value));
      line.push_back(to);
      if (from > to) std::ranges::reverse(line);
    }
    PLASTRON_ASSERT(line.size() == cuts.size() + 2, line.size(), cuts.size());
    return drawn_from(from, to);
  }

  /// The vertices of a side in this direction, which gives an inner curve its conormal.
  std::vector<int> drawn_from(int from, int to) const {
    std::vector<int> line = sides_.at(std::minmax(from, to));
    if (from > to) std::ranges::reverse(line);
    return line;
  }

  const CoarseMesh& whole_;
  CoarseMesh mesh_;
  std::map<std::pair<int, int>, std::vector<int>> sides_;  ///< vertices from the side's smaller end to the larger
};

}  // namespace

CoarseMesh subdivided(const CoarseMesh& mesh, std::span<const std::array<int, 2>> parts) {
  std::vector<Cuts> cuts(parts.size());
  for (std::size_t c = 0; c < parts.size(); ++c)
    for (std::size_t d = 0; d < 2; ++d)
      for (int i = 1; i < parts[c][d]; ++i) cuts[c][d].push_back(static_cast<double>(i) / parts[c][d]);
  return subdivided(mesh, cuts);
}

CoarseMesh subdivided(const CoarseMesh& mesh, std::span<const Cuts> cuts) {
  PLASTRON_ASSERT(mesh.cells.size() == cuts.size(), mesh.cells.size(), cuts.size());
  Subdivision result(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) result.add(mesh.cells[c], cuts[c]);
  return result.finished();
}

}  // namespace plastron::fem
