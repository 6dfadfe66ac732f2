// The cells of a mesh on all ranks, for searches that cross the borders of ranks.
#pragma once
#include <plastron/fem/space.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace plastron::study {

struct GatheredCells {
  std::vector<fem::Cell> all{};  ///< rank after rank, each in the order of its owned cells
  std::vector<int> per_rank{};
  std::size_t first = 0;  ///< of this rank
  std::size_t mine = 0;
};

/// (collective)
GatheredCells gathered_cells(const fem::Space& space);

/// Finds the cells that hold others, of one mesh and a nested finer one.
class HoldingCells {
 public:
  /// Searches the first `count` cells. `cells` must outlive this object.
  HoldingCells(fem::Shape shape, const std::vector<fem::Cell>& cells, std::size_t count);

  /// The number of the cell that `fine` lies in; nothing if there is none.
  std::optional<std::size_t> holding(const fem::Cell& fine) const;

 private:
  fem::Shape shape_;
  const std::vector<fem::Cell>& cells_;
  std::vector<std::vector<std::size_t>> by_coarse_;  // numbers of the cells in each cell of the coarsest mesh
};

}  // namespace plastron::study
