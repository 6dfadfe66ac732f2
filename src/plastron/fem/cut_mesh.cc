#include <plastron/fem/cut_mesh.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace plastron::fem {

namespace {

class Subdivision {
 public:
  explicit Subdivision(const mesh::CoarseMesh& whole) : whole_(whole) {
    mesh_.shape = whole.shape;
    mesh_.vertices = whole.vertices;
    mesh_.regions = whole.regions;
    mesh_.boundaries = whole.boundaries;
    mesh_.patches = whole.patches;
    mesh_.shifts = whole.shifts;
    mesh_.fold_boundaries = whole.fold_boundaries;
  }

  void add(const mesh::CoarseCell& cell, const mesh::Cuts& cuts) {
    const auto columns = static_cast<int>(cuts[0].size()) + 1, rows = static_cast<int>(cuts[1].size()) + 1;
    const auto place = [&](int i, int j) { return Vector2d(place_of(cuts[0], i), place_of(cuts[1], j)); };
    std::vector<int> lattice(static_cast<std::size_t>((columns + 1) * (rows + 1)), -1);
    const auto at = [&](int i, int j) -> int& { return lattice[j * (columns + 1) + i]; };
    for (const int j : {0, rows}) {
      const auto side = side_vertices(cell, j == 0 ? std::array{0, 1} : std::array{2, 3}, cuts[0]);
      for (int i = 0; i <= columns; ++i) at(i, j) = side[i];
    }
    for (const int i : {0, columns}) {
      const auto side = side_vertices(cell, i == 0 ? std::array{0, 2} : std::array{1, 3}, cuts[1]);
      for (int j = 0; j <= rows; ++j) at(i, j) = side[j];
    }
    for (int j = 1; j < rows; ++j)
      for (int i = 1; i < columns; ++i) at(i, j) = add_vertex(cell.map(place(i, j)).value);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const Vector2d from = place(i, j), size = place(i + 1, j + 1) - from;
        const mesh::CellMap map{cell.map.map, cell.map.origin + cell.map.axes * from,
                                cell.map.axes * size.asDiagonal()};
        mesh_.cells.push_back({{at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)}, cell.region, map, cell.patch});
      }
  }

  mesh::CoarseMesh finished() {
    for (const mesh::BoundaryEdge& edge : whole_.edges) {
      const std::vector<int> line = drawn_from(edge.vertices[0], edge.vertices[1]);
      for (std::size_t i = 0; i + 1 < line.size(); ++i) mesh_.edges.push_back({{line[i], line[i + 1]}, edge.boundary});
    }
    PLASTRON_ASSERT(whole_.folds.empty());
    return std::move(mesh_);
  }

 private:
  /// Place of line i: 0, the cuts, 1.
  static double place_of(const std::vector<double>& cuts, int i) {
    if (i == 0) return 0;
    return i > static_cast<int>(cuts.size()) ? 1 : cuts[i - 1];
  }

  int add_vertex(const Vector2d& position) {
    mesh_.vertices.push_back(position);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  /// Vertices from the first of two corners of a cell to the second.
  std::vector<int> side_vertices(const mesh::CoarseCell& cell, const std::array<int, 2>& corners,
                                 const std::vector<double>& cuts) {
    const int from = cell.vertices[corners[0]], to = cell.vertices[corners[1]];
    auto& line = sides_[std::minmax(from, to)];
    if (line.empty()) {
      const Vector2d a = mesh::corner(mesh::Shape::quadrilateral, corners[0]),
                     b = mesh::corner(mesh::Shape::quadrilateral, corners[1]);
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

  const mesh::CoarseMesh& whole_;
  mesh::CoarseMesh mesh_;
  std::map<std::pair<int, int>, std::vector<int>> sides_;  ///< vertices from the side's smaller end to the larger
};

constexpr double same_cut = 1e-9;  ///< part of a side

std::size_t columns(const mesh::CoarseMesh& mesh, std::size_t first) { return mesh.cuts[first][0].size() + 1; }

void insert(double at, std::vector<double>& cuts) {
  const auto is_it = [&](double x) { return std::abs(x - at) <= same_cut; };
  if (std::ranges::any_of(cuts, is_it)) return;
  cuts.insert(std::ranges::upper_bound(cuts, at), at);
}

/// Finds the cell of a cut mesh that contains a point given in the first mesh.
class Lattices {
 public:
  explicit Lattices(const mesh::CoarseMesh& mesh) : mesh_(mesh), cells_(cut_cells(mesh)) {
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].first == begin_.size()) begin_.push_back(c);
  }
  std::size_t cell(std::size_t first, const Vector2d& xi) const {
    if (mesh_.cuts.empty()) return first;
    const mesh::Cuts& cuts = mesh_.cuts[first];
    const auto place = [&](std::size_t d) {
      return static_cast<std::size_t>(std::ranges::upper_bound(cuts[d], xi[static_cast<Eigen::Index>(d)]) -
                                      cuts[d].begin());
    };
    return begin_[first] + place(1) * columns(mesh_, first) + place(0);
  }
  const std::vector<CutCell>& cells() const { return cells_; }

 private:
  const mesh::CoarseMesh& mesh_;
  std::vector<CutCell> cells_;
  std::vector<std::size_t> begin_{};
};

/// Returns the values of a field at the nodes of all cells of all ranks, by coarse cell (collective).
std::vector<double> whole(const algebra::Vector& field, const Space& space) {
  const auto size = static_cast<std::size_t>(space.nodes_per_cell() * field.block());
  std::vector<int> mine;
  std::vector<double> values;
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    mine.push_back(space.cells[cell].coarse);
    for (const algebra::LocalIndex node : space.nodes(cell))
      std::ranges::copy(field.at(static_cast<std::size_t>(node)), std::back_inserter(values));
  }
  const std::vector<int> cells = algebra::gathered(mine, space.layout->comm);
  values = algebra::gathered(values, space.layout->comm);
  std::vector<double> all(space.coarse->cells.size() * size);
  for (std::size_t k = 0; k < cells.size(); ++k)
    std::copy_n(&values[k * size], size, &all[static_cast<std::size_t>(cells[k]) * size]);
  return all;
}

}  // namespace

mesh::CoarseMesh subdivided(const mesh::CoarseMesh& mesh, std::span<const std::array<int, 2>> parts) {
  std::vector<mesh::Cuts> cuts(parts.size());
  for (std::size_t c = 0; c < parts.size(); ++c)
    for (std::size_t d = 0; d < 2; ++d)
      for (int i = 1; i < parts[c][d]; ++i) cuts[c][d].push_back(static_cast<double>(i) / parts[c][d]);
  return subdivided(mesh, cuts);
}

mesh::CoarseMesh subdivided(const mesh::CoarseMesh& mesh, std::span<const mesh::Cuts> cuts) {
  PLASTRON_ASSERT(mesh.cells.size() == cuts.size(), mesh.cells.size(), cuts.size());
  Subdivision result(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) result.add(mesh.cells[c], cuts[c]);
  return result.finished();
}

mesh::CoarseMesh cut_mesh(const mesh::CoarseMesh& first, std::vector<mesh::Cuts> cuts) {
  mesh::CoarseMesh mesh = subdivided(first, cuts);
  mesh.cuts = std::move(cuts);
  return mesh;
}

bool are_conforming(const mesh::CoarseMesh& mesh, std::span<const mesh::Cuts> cuts) {
  if (cuts.size() != mesh.cells.size()) return false;
  std::map<std::pair<int, int>, std::vector<double>> sides;
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (int side = 0; side < 4; ++side) {
      const auto [from, to] = mesh::side_corners(mesh::Shape::quadrilateral, side);
      const int a = mesh.cells[c].vertices[from], b = mesh.cells[c].vertices[to];
      std::vector<double> points = cuts[c][side < 2 ? 1 : 0];
      if (a > b) {
        std::ranges::reverse(points);
        for (double& x : points) x = 1 - x;
      }
      const auto [other, is_new] = sides.try_emplace(std::minmax(a, b), points);
      const auto near = [](double x, double y) { return std::abs(x - y) <= 2 * same_cut; };
      if (!is_new && !std::ranges::equal(other->second, points, near)) return false;
    }
  return true;
}

std::vector<CutCell> cut_cells(const mesh::CoarseMesh& mesh) {
  std::vector<CutCell> all;
  if (mesh.cuts.empty())
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) all.push_back({c, Vector2d::Zero(), Vector2d::Ones()});
  for (std::size_t first = 0; first < mesh.cuts.size(); ++first) {
    std::array<std::vector<double>, 2> lines = mesh.cuts[first];
    for (std::vector<double>& points : lines) {
      points.insert(points.begin(), 0);
      points.push_back(1);
    }
    const auto& [x, y] = lines;
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
      for (std::size_t i = 0; i + 1 < x.size(); ++i)
        all.push_back({first, {x[i], y[j]}, {x[i + 1] - x[i], y[j + 1] - y[j]}});
  }
  PLASTRON_ASSERT(all.size() == mesh.cells.size(), all.size(), mesh.cells.size());
  return all;
}

std::vector<mesh::Cuts> with_cuts(const mesh::CoarseMesh& present, std::span<const mesh::Cuts> cuts) {
  PLASTRON_ASSERT(cuts.size() == present.cells.size(), cuts.size(), present.cells.size());
  const std::vector<CutCell> cells = cut_cells(present);
  std::vector<mesh::Cuts> all = present.cuts;
  all.resize(cells.back().first + 1);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t d = 0; d < 2; ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      for (const double x : cuts[c][d]) insert(cells[c].corner[k] + cells[c].size[k] * x, all[cells[c].first][d]);
    }
  return all;
}

algebra::Vector interpolated(const algebra::Vector& field, const Space& before, const Space& after) {
  const std::vector<double> values = whole(field, before);
  const Lattices old_cells(*before.coarse);
  const std::vector<CutCell> new_cells = cut_cells(*after.coarse);
  const std::vector<double> nodes = mesh::gauss_lobatto(after.degree + 1).points;
  const std::size_t n = nodes.size();
  const auto block = static_cast<std::size_t>(field.block());
  algebra::Vector result(after.layout, field.block());
  for (std::size_t cell = 0; cell < after.owned_cells; ++cell) {
    const CutCell& here = new_cells[after.cells[cell].coarse];
    for (std::size_t i = 0; i < n * n; ++i) {
      const auto node = static_cast<std::size_t>(after.nodes(cell)[i]);
      if (node >= static_cast<std::size_t>(after.layout->owned)) continue;
      const Vector2d xi = here.corner + here.size.cwiseProduct(Vector2d(nodes[i % n], nodes[i / n]));
      const std::size_t from = old_cells.cell(here.first, xi);
      const CutCell& old = old_cells.cells()[from];
      const Vector2d there = (xi - old.corner).cwiseQuotient(old.size);
      const Eigen::VectorXd across = mesh::lagrange(nodes, there[0]).value,
                            along = mesh::lagrange(nodes, there[1]).value;
      for (std::size_t k = 0; k < block; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < n * n; ++j)
          sum += across[static_cast<Eigen::Index>(j % n)] * along[static_cast<Eigen::Index>(j / n)] *
                 values[(from * n * n + j) * block + k];
        result.owned()[node * block + k] = sum;
      }
    }
  }
  result.update_ghosts();
  return result;
}

}  // namespace plastron::fem
