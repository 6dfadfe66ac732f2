#include <plastron/study/reference_strains.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace plastron::study {

namespace {

using assembly::CellStrain;

constexpr std::size_t packed_size = 4;

std::vector<double> packed(const fem::Space& space) {
  std::vector<double> values;
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const fem::Cell& cell = space.cells[c];
    values.insert(values.end(), {static_cast<double>(cell.coarse), cell.corner[0], cell.corner[1], cell.size});
  }
  return values;
}

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
  explicit Evaluator(const computation::Solution& solution) : solution_(solution), shell_(solution.discrete->shell) {
    for (std::size_t c = 0; c < shell_.space().owned_cells; ++c)
      by_coarse_[shell_.space().cells[c].coarse].push_back(c);
  }

  /// Nothing if the fine cell lies in no cell of this rank.
  std::optional<CellStrain> operator()(const fem::Cell& fine) {
    for (const std::size_t c : by_coarse_[fine.coarse]) {
      const fem::Cell& cell = shell_.space().cells[c];
      const Eigen::Vector2d middle = fine.corner + fine.size * Eigen::Vector2d(0.3, 0.3);  // of square and triangle
      if (!fem::local_coordinates(shell_.space().shape(), cell, {fine.coarse, middle})) continue;
      return strains(c, {(fine.corner - cell.corner) / cell.size, fine.size / cell.size});
    }
    return std::nullopt;
  }

 private:
  CellStrain strains(std::size_t c, const Part& part) {
    const PartTables& tables = tables_of(part);
    std::vector<geometry::SurfaceJet> jets(tables.basis.xi.size());
    shell_.surface().jets(shell_.space().cells[c], tables.basis.xi, jets);
    CellStrain result = shell_.strains_at(c, shell_.gather(c, solution_.nodal.y), tables.basis, tables.tied, jets);
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

  const computation::Solution& solution_;
  const assembly::ShellOperator& shell_;
  std::map<int, std::vector<std::size_t>> by_coarse_;
  std::map<std::tuple<long, long, long>, PartTables> tables_;
};

}  // namespace

ReferenceStrains::ReferenceStrains(const fem::Space& reference) : comm_(reference.layout->comm) {
  int ranks = 1, rank = 0;
  MPI_Comm_size(comm_, &ranks);
  MPI_Comm_rank(comm_, &rank);
  per_rank_.resize(static_cast<std::size_t>(ranks));
  const int mine = static_cast<int>(reference.owned_cells);
  MPI_Allgather(&mine, 1, MPI_INT, per_rank_.data(), 1, MPI_INT, comm_);
  first_ = static_cast<std::size_t>(std::accumulate(per_rank_.begin(), per_rank_.begin() + rank, 0));
  cells_ = algebra::gather_over_ranks(packed(reference), comm_);
}

fem::Cell ReferenceStrains::cell(std::size_t number) const {
  const double* p = cells_.data() + packed_size * number;
  return {static_cast<int>(p[0]), {p[1], p[2]}, p[3]};
}

bool ReferenceStrains::fits(const fem::Space& space) const {
  const auto values = packed(space);
  const bool same = first_ * packed_size + values.size() <= cells_.size() &&
                    std::equal(values.begin(), values.end(), cells_.begin() + static_cast<long>(first_ * packed_size));
  return algebra::sum_over_ranks(static_cast<std::int64_t>(same ? 0 : 1), comm_) == 0;
}

// Each rank fills in the cells it can see; a sum over the ranks brings them to their owners.
std::vector<CellStrain> ReferenceStrains::of(const computation::Solution& coarse) const {
  Evaluator evaluate(coarse);
  const Eigen::Index points = coarse.discrete->shell.tables().points_per_cell();
  const auto per_cell = static_cast<std::size_t>(8 * points);
  algebra::check_gathered(static_cast<std::int64_t>(cells_.size() / packed_size * per_cell));
  std::vector<double> all(cells_.size() / packed_size * per_cell, 0.0);
  for (std::size_t c = 0; c < cells_.size() / packed_size; ++c)
    if (const auto strains = evaluate(cell(c))) Eigen::Map<CellStrain>(all.data() + c * per_cell, points, 8) = *strains;
  std::vector<int> counts;
  for (const int n : per_rank_) counts.push_back(n * static_cast<int>(per_cell));
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const auto owned = static_cast<std::size_t>(per_rank_[static_cast<std::size_t>(rank)]);
  std::vector<double> mine(owned * per_cell + 1);  // never empty
  MPI_Reduce_scatter(all.data(), mine.data(), counts.data(), MPI_DOUBLE, MPI_SUM, comm_);
  std::vector<CellStrain> result;
  for (std::size_t c = 0; c < owned; ++c)
    result.emplace_back(Eigen::Map<const CellStrain>(mine.data() + c * per_cell, points, 8));
  return result;
}

}  // namespace plastron::study
