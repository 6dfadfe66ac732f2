#include <research/study/nodal_interpolant.hpp>

#include <plastron/element/element_tables.hpp>
#include <plastron/fem/surface.hpp>
#include <research/study/gathered_cells.hpp>

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace plastron::study {

namespace {

constexpr std::size_t sum_entries = 7;  // (u, r) from every cell that sees the node, and how many do

/// The nodes of a coarse cell that lie in a fine one: their numbers in the coarse cell, and where they are in the fine one.
struct NodesInside {
  std::vector<std::size_t> numbers;
  std::vector<Eigen::Vector2d> xi;
};

NodesInside nodes_inside(fem::Shape shape, const fem::Cell& coarse, const fem::Cell& fine,
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
std::vector<double> sums_here(const GatheredCells& coarse, const assembly::ShellOperator& fine,
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

}  // namespace

algebra::Vector values_at_nodes(const fem::Space& coarse, const assembly::ShellOperator& fine,
                                const algebra::Vector& y) {
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

}  // namespace plastron::study
