#include <research/study/reference_strains.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>

namespace plastron::study {

namespace {

using assembly::CellStrain;

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
  Evaluator(const assembly::ShellOperator& shell, const algebra::Vector& y)
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
    std::vector<geometry::SurfaceJet> jets(tables.basis.xi.size());
    shell_.surface().jets(shell_.space().cells[c], tables.basis.xi, jets);
    CellStrain result = shell_.strains_at(c, shell_.gather(c, y_), tables.basis, tables.tied, jets);
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

  const assembly::ShellOperator& shell_;
  const algebra::Vector& y_;
  HoldingCells cells_;
  std::map<std::tuple<long, long, long>, PartTables> tables_;
};

}  // namespace

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
std::vector<CellStrain> ReferenceStrains::of(const assembly::ShellOperator& coarse, const algebra::Vector& y) const {
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
