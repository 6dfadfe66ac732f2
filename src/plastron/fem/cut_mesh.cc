#include <plastron/fem/cut_mesh.hpp>

#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/basis.hpp>
#include <plastron/fem/subdivided_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plastron::fem {

namespace {

constexpr double same_cut = 1e-9;  ///< part of a side

std::size_t columns(const CoarseMesh& mesh, std::size_t first) { return mesh.cuts[first][0].size() + 1; }

void insert(double at, std::vector<double>& cuts) {
  const auto is_it = [&](double x) { return std::abs(x - at) <= same_cut; };
  if (std::ranges::any_of(cuts, is_it)) return;
  cuts.insert(std::ranges::upper_bound(cuts, at), at);
}

/// Finds the cell of a cut mesh that contains a point given in the first mesh.
class Lattices {
 public:
  explicit Lattices(const CoarseMesh& mesh) : mesh_(mesh), cells_(cut_cells(mesh)) {
    for (std::size_t c = 0; c < cells_.size(); ++c)
      if (cells_[c].first == begin_.size()) begin_.push_back(c);
  }
  std::size_t cell(std::size_t first, const Vector2d& xi) const {
    if (mesh_.cuts.empty()) return first;
    const Cuts& cuts = mesh_.cuts[first];
    const auto place = [&](std::size_t d) {
      return static_cast<std::size_t>(std::ranges::upper_bound(cuts[d], xi[static_cast<Eigen::Index>(d)]) -
                                      cuts[d].begin());
    };
    return begin_[first] + place(1) * columns(mesh_, first) + place(0);
  }
  const std::vector<CutCell>& cells() const { return cells_; }

 private:
  const CoarseMesh& mesh_;
  std::vector<CutCell> cells_;
  std::vector<std::size_t> begin_{};
};

/// Returns the values of a field at the nodes of all cells of all ranks, by coarse cell (collective).
std::vector<double> whole(const algebra::Vector& field, const Space& space) {
  const auto block = static_cast<std::size_t>(field.block());
  const std::size_t size = static_cast<std::size_t>(space.nodes_per_cell()) * block;
  std::vector<double> mine;
  mine.reserve(space.owned_cells * (size + 1));
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    mine.push_back(space.cells[cell].coarse);
    for (const algebra::LocalIndex node : space.nodes(cell)) {
      const auto values = field.local().subspan(static_cast<std::size_t>(node) * block, block);
      mine.insert(mine.end(), values.begin(), values.end());
    }
  }
  const std::vector<double> records = algebra::gather_over_ranks(mine, space.layout->comm);
  std::vector<double> all(space.coarse->cells.size() * size);
  for (auto record = records.begin(); record != records.end(); record += static_cast<std::ptrdiff_t>(size + 1))
    std::copy_n(record + 1, size,
                all.begin() + static_cast<std::ptrdiff_t>(*record) * static_cast<std::ptrdiff_t>(size));
  return all;
}

}  // namespace

CoarseMesh cut_mesh(const CoarseMesh& first, std::vector<Cuts> cuts) {
  CoarseMesh mesh = subdivided(first, cuts);
  mesh.cuts = std::move(cuts);
  return mesh;
}

bool are_conforming(const CoarseMesh& mesh, std::span<const Cuts> cuts) {
  if (cuts.size() != mesh.cells.size()) return false;
  std::map<std::pair<int, int>, std::vector<double>> sides;
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (int side = 0; side < 4; ++side) {
      const auto [from, to] = side_corners(Shape::quadrilateral, side);
      const int a = mesh.cells[c].vertices[static_cast<std::size_t>(from)],
                b = mesh.cells[c].vertices[static_cast<std::size_t>(to)];
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

std::vector<CutCell> cut_cells(const CoarseMesh& mesh) {
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

std::vector<Cuts> with_cuts(const CoarseMesh& present, std::span<const Cuts> cuts) {
  PLASTRON_ASSERT(cuts.size() == present.cells.size(), cuts.size(), present.cells.size());
  const std::vector<CutCell> cells = cut_cells(present);
  std::vector<Cuts> all = present.cuts;
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
  const std::vector<double> nodes = gauss_lobatto(after.degree + 1).points;
  const std::size_t n = nodes.size();
  const auto block = static_cast<std::size_t>(field.block());
  algebra::Vector result(after.layout, field.block());
  for (std::size_t cell = 0; cell < after.owned_cells; ++cell) {
    const CutCell& here = new_cells[static_cast<std::size_t>(after.cells[cell].coarse)];
    for (std::size_t i = 0; i < n * n; ++i) {
      const auto node = static_cast<std::size_t>(after.nodes(cell)[i]);
      if (node >= static_cast<std::size_t>(after.layout->owned)) continue;
      const Vector2d xi = here.corner + here.size.cwiseProduct(Vector2d(nodes[i % n], nodes[i / n]));
      const std::size_t from = old_cells.cell(here.first, xi);
      const CutCell& old = old_cells.cells()[from];
      const Vector2d there = (xi - old.corner).cwiseQuotient(old.size);
      const Eigen::VectorXd across = lagrange(nodes, there[0]).value, along = lagrange(nodes, there[1]).value;
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
