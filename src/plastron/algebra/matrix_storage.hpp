// The data of a Matrix. For matrix*.cc and factorisation*.cc only.
#pragma once
#include <plastron/algebra/connectivity.hpp>
#include <plastron/algebra/layout.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace plastron::algebra {

/// Compressed rows of blocks. The rows of ghosts are last and collect the values for their owners. In each row the
/// columns ascend in global numbering. No column is below the row, since lower blocks are not stored. An owned row
/// begins with its diagonal.
struct MatrixStorage {
  std::shared_ptr<const Layout> layout{};  ///< layout of the vectors and of the elements' nodes
  /// The same owned nodes, with every column of owned rows as a ghost. It is `layout` itself where that is sufficient
  /// on every rank.
  std::shared_ptr<const Layout> wide{};
  std::vector<LocalIndex> ghost_in_wide{};  ///< index in `wide` of each ghost of `layout`
  int block = 0;
  std::vector<GlobalIndex> global{};         ///< global number of each node of `wide`
  std::vector<std::int64_t> row_start{};     ///< in blocks, for every node of `wide`
  std::vector<LocalIndex> column{};          ///< node of `wide`, for each block
  std::vector<double> values{};              ///< values of the blocks, row-major inside
  ItemsOfNeighbours outgoing{}, incoming{};  ///< blocks that finish() sends between neighbours in `layout`
  std::vector<std::size_t> target{};         ///< the block to which each incoming one is added
  mutable std::vector<double> work{};        ///< scratch for products: two vectors on `wide`

  std::size_t block_area() const { return static_cast<std::size_t>(block) * static_cast<std::size_t>(block); }
  std::size_t owned_unknowns() const {
    return static_cast<std::size_t>(layout->owned) * static_cast<std::size_t>(block);
  }
  std::size_t row_begin(LocalIndex row) const {
    return static_cast<std::size_t>(row_start[static_cast<std::size_t>(row)]);
  }
  std::size_t row_end(LocalIndex row) const { return row_begin(row + 1); }
  const double* block_at(std::size_t k) const { return values.data() + k * block_area(); }
  double* block_at(std::size_t k) { return values.data() + k * block_area(); }

  LocalIndex in_wide(LocalIndex node) const {
    return node < layout->owned ? node : ghost_in_wide[static_cast<std::size_t>(node - layout->owned)];
  }
  /// Returns the place of block (row, column). Throws std::out_of_range if it is not in the pattern.
  std::size_t find(LocalIndex row, GlobalIndex column_global) const;
};

/// Gives A (layout and block set) its pattern (collective).
void build_pattern(MatrixStorage& A, const Connectivity& elements);

}  // namespace plastron::algebra
