#include <research/study/nested_meshes.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/fem/surface.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

namespace plastron::study {

namespace {

// ---- cells -------------------------------------------------------------------------------------------------------------

/// (collective)
GatheredCells gathered_cells(const fem::Space& space) {
  const MPI_Comm comm = space.layout->comm;
  int ranks = 1, rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  GatheredCells cells{.per_rank = std::vector<int>(static_cast<std::size_t>(ranks)), .mine = space.owned_cells};
  const int mine = static_cast<int>(space.owned_cells);
  MPI_Allgather(&mine, 1, MPI_INT, cells.per_rank.data(), 1, MPI_INT, comm);
  cells.first = static_cast<std::size_t>(std::accumulate(cells.per_rank.begin(), cells.per_rank.begin() + rank, 0));
  cells.all = algebra::gathered(std::span(space.cells).first(space.owned_cells), comm);
  return cells;
}

/// Finds the cells that contain others, of one mesh and a nested finer one.
class HoldingCells {
 public:
  /// Searches the first `count` cells. `cells` must outlive this object.
  HoldingCells(mesh::Shape shape, const std::vector<fem::Cell>& cells, std::size_t count)
      : shape_(shape), cells_(cells) {
    for (std::size_t c = 0; c < count; ++c) {
      const auto coarse = static_cast<std::size_t>(cells[c].coarse);
      by_coarse_.resize(std::max(by_coarse_.size(), coarse + 1));
      by_coarse_[coarse].push_back(c);
    }
  }

  /// The number of the cell that `fine` lies in; nothing if there is none.
  std::optional<std::size_t> holding(const fem::Cell& fine) const {
    const auto coarse = static_cast<std::size_t>(fine.coarse);
    if (coarse >= by_coarse_.size()) return std::nullopt;
    const Eigen::Vector2d middle = fine.corner + fine.size * Eigen::Vector2d(0.3, 0.3);  // of square and triangle
    for (const std::size_t c : by_coarse_[coarse])
      if (fem::local_coordinates(shape_, cells_[c], {fine.coarse, middle})) return c;
    return std::nullopt;
  }

 private:
  mesh::Shape shape_;
  const std::vector<fem::Cell>& cells_;
  std::vector<std::vector<std::size_t>> by_coarse_;  // numbers of the cells in each cell of the coarsest mesh
};

// ---- values at nodes ---------------------------------------------------------------------------------------------------

constexpr std::size_t sum_entries = 7;  // (u, r) from every cell that sees the node, and how many do

/// The nodes of a coarse cell that lie in a fine one: their numbers in the coarse cell, and where they are in the fine one.
struct NodesInside {
  std::vector<std::size_t> numbers;
  std::vector<Eigen::Vector2d> xi;
};

NodesInside nodes_inside(mesh::Shape shape, const fem::Cell& coarse, const fem::Cell& fine,
                         const std::vector<Eigen::Vector2d>& nodes) {
  NodesInside inside;
  for (std::size_t j = 0; j < nodes.size(); ++j)
    if (const auto xi = fem::local_coordinates(shape, fine, {coarse.coarse, coarse.corner + coarse.size * nodes[j]})) {
      inside.numbers.push_back(j);
      inside.xi.push_back(*xi);
    }
  return inside;
}

/// Sums over the fine cells of this rank, coarse cell after coarse cell and node after node.
std::vector<double> sums_here(const GatheredCells& coarse, const energy::ShellOperator& fine,
                              const algebra::Vector& y) {
  const fem::Space& space = fine.space();
  const auto& nodes = fine.tables().nodes;
  const HoldingCells coarse_cells(space.shape(), coarse.all, coarse.all.size());
  std::vector<double> sums(coarse.all.size() * nodes.size() * sum_entries);
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const auto holding = coarse_cells.holding(space.cells[c]);
    if (!holding) continue;
    const NodesInside inside = nodes_inside(space.shape(), coarse.all[*holding], space.cells[c], nodes);
    if (inside.numbers.empty()) continue;
    const element::CellField values =
        fine.interpolation().values(c, element::basis_at(space.shape(), space.degree, inside.xi), fine.gather(c, y));
    for (std::size_t p = 0; p < inside.numbers.size(); ++p) {
      double* sum = sums.data() + (*holding * nodes.size() + inside.numbers[p]) * sum_entries;
      for (int k = 0; k < 6; ++k) sum[k] += values(static_cast<Eigen::Index>(p), k);
      sum[6] += 1;
    }
  }
  return sums;
}

// ---- strains -----------------------------------------------------------------------------------------------------------

using energy::CellStrain;

/// A reference cell seen from the coarse cell that holds it: xi_coarse = corner + size xi_fine.
struct Part {
  Eigen::Vector2d corner;
  double size;
};

/// Tables of the coarse element at the quadrature points of a part of it.
struct PartTables {
  element::BasisAt basis;
  std::vector<Eigen::MatrixXd> tied;
};

class Evaluator {
 public:
  Evaluator(const energy::ShellOperator& shell, const algebra::Vector& y)
      : shell_(shell), y_(y), cells_(shell.space().shape(), shell.space().cells, shell.space().owned_cells) {}

  /// Nothing if the fine cell lies in no cell of this rank.
  std::optional<CellStrain> operator()(const fem::Cell& fine) {
    const auto c = cells_.holding(fine);
    if (!c) return std::nullopt;
    const fem::Cell& cell = shell_.space().cells[*c];
    return strains(*c, {(fine.corner - cell.corner) / cell.size, fine.size / cell.size});
  }

 private:
  CellStrain strains(std::size_t c, const Part& part) {
    const PartTables& tables = tables_of(part);
    std::vector<geometry::Frame> frames(tables.basis.xi.size());
    shell_.surface().frames(shell_.space().cells[c], tables.basis.xi, frames);
    CellStrain result = shell_.strains_at(c, shell_.gather(c, y_), tables.basis, tables.tied, frames);
    result.leftCols<6>() *= part.size * part.size;  // gamma_ab, chi_ab: two covariant indices
    result.rightCols<2>() *= part.size;             // delta_a: one
    return result;
  }

  const PartTables& tables_of(const Part& part) {
    const double n = std::round(1 / std::abs(part.size));
    const auto key =
        std::tuple(std::lround(n * part.corner[0]), std::lround(n * part.corner[1]), std::lround(1 / part.size));
    const auto found = tables_.find(key);
    if (found != tables_.end()) return found->second;
    std::vector<Eigen::Vector2d> xi;
    for (const Eigen::Vector2d& p : shell_.tables().quadrature.xi) xi.emplace_back(part.corner + part.size * p);
    return tables_
        .emplace(key, PartTables{element::basis_at(shell_.space().shape(), shell_.space().degree, xi),
                                 element::tied_interpolation(shell_.tables(), xi)})
        .first->second;
  }

  const energy::ShellOperator& shell_;
  const algebra::Vector& y_;
  HoldingCells cells_;
  std::map<std::tuple<long, long, long>, PartTables> tables_;
};

}  // namespace

algebra::Vector values_at_nodes(const fem::Space& coarse, const energy::ShellOperator& fine, const algebra::Vector& y) {
  const GatheredCells cells = gathered_cells(coarse);
  std::vector<double> sums = sums_here(cells, fine, y);
  algebra::check_gathered(static_cast<std::int64_t>(sums.size()));
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, coarse.layout->comm);
  algebra::Vector result(coarse.layout, 6);
  for (std::size_t c = 0; c < cells.mine; ++c) {
    const auto nodes = coarse.nodes(c);
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const double* sum = sums.data() + ((cells.first + c) * nodes.size() + j) * sum_entries;
      for (std::size_t k = 0; k < 6; ++k)
        result.local()[static_cast<std::size_t>(nodes[j]) * 6 + k] = sum[k] / std::max(1.0, sum[6]);
    }
  }
  result.update_ghosts();
  return result;
}

ReferenceStrains::ReferenceStrains(const fem::Space& reference)
    : comm_(reference.layout->comm), cells_(gathered_cells(reference)) {}

bool ReferenceStrains::fits(const fem::Space& space) const {
  const auto is_same = [](const fem::Cell& a, const fem::Cell& b) { return fem::place_of(a) == fem::place_of(b); };
  const auto first = cells_.all.begin() + static_cast<std::ptrdiff_t>(cells_.first);
  const bool same =
      space.owned_cells == cells_.mine &&
      std::equal(space.cells.begin(), space.cells.begin() + static_cast<std::ptrdiff_t>(cells_.mine), first, is_same);
  return algebra::sum_over_ranks(static_cast<std::int64_t>(same ? 0 : 1), comm_) == 0;
}

// Each rank fills in the cells it can see; a sum over the ranks brings them to their owners.
std::vector<CellStrain> ReferenceStrains::of(const energy::ShellOperator& coarse, const algebra::Vector& y) const {
  Evaluator evaluate(coarse, y);
  const Eigen::Index points = coarse.tables().points_per_cell();
  const auto per_cell = static_cast<std::size_t>(8 * points);
  algebra::check_gathered(static_cast<std::int64_t>(cells_.all.size() * per_cell));
  std::vector<double> all(cells_.all.size() * per_cell, 0.0);
  for (std::size_t c = 0; c < cells_.all.size(); ++c)
    if (const auto strains = evaluate(cells_.all[c]))
      Eigen::Map<CellStrain>(all.data() + c * per_cell, points, 8) = *strains;
  std::vector<int> counts;
  for (const int n : cells_.per_rank) counts.push_back(n * static_cast<int>(per_cell));
  std::vector<double> mine(cells_.mine * per_cell + 1);  // never empty
  MPI_Reduce_scatter(all.data(), mine.data(), counts.data(), MPI_DOUBLE, MPI_SUM, comm_);
  std::vector<CellStrain> result;
  for (std::size_t c = 0; c < cells_.mine; ++c)
    result.emplace_back(Eigen::Map<const CellStrain>(mine.data() + c * per_cell, points, 8));
  return result;
}

}  // namespace plastron::study
