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

  void add(const CoarseCell& cell, const std::array<int, 2>& parts) {
    const int columns = parts[0], rows = parts[1];
    std::vector<int> lattice(static_cast<std::size_t>((columns + 1) * (rows + 1)), -1);
    const auto at = [&](int i, int j) -> int& { return lattice[static_cast<std::size_t>(j * (columns + 1) + i)]; };
    for (const int j : {0, rows}) {
      const auto side = side_vertices(cell, j == 0 ? std::array{0, 1} : std::array{2, 3}, columns);
      for (int i = 0; i <= columns; ++i) at(i, j) = side[static_cast<std::size_t>(i)];
    }
    for (const int i : {0, columns}) {
      const auto side = side_vertices(cell, i == 0 ? std::array{0, 2} : std::array{1, 3}, rows);
      for (int j = 0; j <= rows; ++j) at(i, j) = side[static_cast<std::size_t>(j)];
    }
    const Vector2d size(1.0 / columns, 1.0 / rows);
    for (int j = 1; j < rows; ++j)
      for (int i = 1; i < columns; ++i) at(i, j) = add_vertex(cell.map(size.cwiseProduct(Vector2d(i, j))).value);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const CellMap map{cell.map.map, cell.map.origin + cell.map.axes * size.cwiseProduct(Vector2d(i, j)),
                          cell.map.axes * size.asDiagonal()};
        mesh_.cells.push_back({{at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}, cell.region, map});
      }
  }

  CoarseMesh finished() {
    for (const BoundaryEdge& edge : whole_.edges) {
      const auto& line = sides_.at(std::minmax(edge.vertices[0], edge.vertices[1]));
      for (std::size_t i = 0; i + 1 < line.size(); ++i) mesh_.edges.push_back({{line[i], line[i + 1]}, edge.boundary});
    }
    return std::move(mesh_);
  }

 private:
  int add_vertex(const Vector2d& position) {
    mesh_.vertices.push_back(position);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  /// From the first of two corners of a cell to the second.
  std::vector<int> side_vertices(const CoarseCell& cell, const std::array<int, 2>& corners, int parts) {
    const int from = cell.vertices[static_cast<std::size_t>(corners[0])],
              to = cell.vertices[static_cast<std::size_t>(corners[1])];
    auto& line = sides_[std::minmax(from, to)];
    if (line.empty()) {
      const Vector2d a = corner(Shape::quadrilateral, corners[0]), b = corner(Shape::quadrilateral, corners[1]);
      line.push_back(from);
      for (int i = 1; i < parts; ++i) line.push_back(add_vertex(cell.map(a + (b - a) * i / parts).value));
      line.push_back(to);
      if (from > to) std::ranges::reverse(line);
    }
    PLASTRON_ASSERT(static_cast<int>(line.size()) == parts + 1, line.size(), parts);
    std::vector<int> result = line;
    if (from > to) std::ranges::reverse(result);
    return result;
  }

  const CoarseMesh& whole_;
  CoarseMesh mesh_;
  std::map<std::pair<int, int>, std::vector<int>> sides_;  ///< from the vertex of the smaller number to the other
};

}  // namespace

CoarseMesh subdivided(const CoarseMesh& mesh, std::span<const std::array<int, 2>> parts) {
  PLASTRON_ASSERT(mesh.cells.size() == parts.size(), mesh.cells.size(), parts.size());
  Subdivision result(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) result.add(mesh.cells[c], parts[c]);
  return result.finished();
}

}  // namespace plastron::fem
