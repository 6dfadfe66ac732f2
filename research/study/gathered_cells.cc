#include <research/study/gathered_cells.hpp>

#include <plastron/algebra/vector.hpp>
#include <plastron/fem/surface.hpp>

#include <mpi.h>

#include <algorithm>
#include <numeric>

namespace plastron::study {

namespace {

constexpr std::size_t cell_entries = 4;  // coarse, corner, size

std::vector<double> packed_cells(const fem::Space& space) {
  std::vector<double> values;
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const fem::Cell& cell = space.cells[c];
    values.insert(values.end(), {static_cast<double>(cell.coarse), cell.corner[0], cell.corner[1], cell.size});
  }
  return values;
}

}  // namespace

GatheredCells gathered_cells(const fem::Space& space) {
  const MPI_Comm comm = space.layout->comm;
  int ranks = 1, rank = 0;
  MPI_Comm_size(comm, &ranks);
  MPI_Comm_rank(comm, &rank);
  GatheredCells cells{.per_rank = std::vector<int>(static_cast<std::size_t>(ranks)), .mine = space.owned_cells};
  const int mine = static_cast<int>(space.owned_cells);
  MPI_Allgather(&mine, 1, MPI_INT, cells.per_rank.data(), 1, MPI_INT, comm);
  cells.first = static_cast<std::size_t>(std::accumulate(cells.per_rank.begin(), cells.per_rank.begin() + rank, 0));
  const std::vector<double> values = algebra::gather_over_ranks(packed_cells(space), comm);
  for (std::size_t at = 0; at < values.size(); at += cell_entries)
    cells.all.push_back({static_cast<int>(values[at]), {values[at + 1], values[at + 2]}, values[at + 3]});
  return cells;
}

HoldingCells::HoldingCells(fem::Shape shape, const std::vector<fem::Cell>& cells, std::size_t count)
    : shape_(shape), cells_(cells) {
  for (std::size_t c = 0; c < count; ++c) {
    const auto coarse = static_cast<std::size_t>(cells[c].coarse);
    by_coarse_.resize(std::max(by_coarse_.size(), coarse + 1));
    by_coarse_[coarse].push_back(c);
  }
}

std::optional<std::size_t> HoldingCells::holding(const fem::Cell& fine) const {
  const auto coarse = static_cast<std::size_t>(fine.coarse);
  if (coarse >= by_coarse_.size()) return std::nullopt;
  const Eigen::Vector2d middle = fine.corner + fine.size * Eigen::Vector2d(0.3, 0.3);  // of square and triangle
  for (const std::size_t c : by_coarse_[coarse])
    if (fem::local_coordinates(shape_, cells_[c], {fine.coarse, middle})) return c;
  return std::nullopt;
}

}  // namespace plastron::study
