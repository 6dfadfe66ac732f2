// The part of a Matrix that one rank has added, as a separate matrix: the matrix of a subdomain in domain
// decomposition.
#include <plastron/algebra/matrix.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "matrix_storage.hpp"

namespace plastron::algebra {
namespace {

constexpr LocalIndex elsewhere = -1;

/// Returns the local node of `layout` for each node of `wide`; `elsewhere` for nodes that only other ranks' elements
/// couple.
std::vector<LocalIndex> nodes_of_wide(const Matrix::Storage& A) {
  std::vector<LocalIndex> nodes(A.global.size(), elsewhere);
  for (LocalIndex i = 0; i < A.layout->local_size(); ++i) nodes[static_cast<std::size_t>(A.in_wide(i))] = i;
  return nodes;
}

/// A block of A at its place in the local matrix. The order there is different, with ghosts last. `source` may have to
/// be transposed.
struct PlacedBlock {
  LocalIndex row, column;
  std::size_t source;
  bool transposed;
};

std::vector<PlacedBlock> placed_blocks(const Matrix::Storage& A) {
  const auto node_of = nodes_of_wide(A);
  std::vector<PlacedBlock> blocks;
  blocks.reserve(A.column.size());
  for (LocalIndex w = 0; w < A.wide->local_size(); ++w) {
    const LocalIndex row = node_of[static_cast<std::size_t>(w)];
    for (std::size_t k = A.row_begin(w); k < A.row_end(w); ++k) {
      const LocalIndex column = node_of[static_cast<std::size_t>(A.column[k])];
      if (row == elsewhere || column == elsewhere) continue;
      blocks.push_back({std::min(row, column), std::max(row, column), k, column < row});
    }
  }
  std::ranges::sort(blocks, {}, [](const PlacedBlock& b) { return std::pair(b.row, b.column); });
  return blocks;
}

/// Returns a layout of one rank's nodes, without other ranks.
std::shared_ptr<const Layout> layout_of_its_own(LocalIndex nodes) {
  return std::make_shared<const Layout>(Distribution{.owned = nodes, .global_size = nodes});
}

}  // namespace

Matrix Matrix::local_part() const {
  const Storage& A = *storage_;
  if (A.has_finished) throw std::logic_error("a matrix has no local part once finish() has shipped rows of ghosts");
  auto part = std::make_unique<Storage>();
  part->layout = part->wide = layout_of_its_own(A.layout->local_size());
  part->block = A.block;
  for (LocalIndex i = 0; i < part->layout->owned; ++i) part->global.push_back(i);
  const auto blocks = placed_blocks(A);
  const auto m = static_cast<std::size_t>(A.block);
  part->row_start.assign(part->global.size() + 1, 0);
  part->column.reserve(blocks.size());
  part->values.reserve(blocks.size() * A.block_area());
  for (const PlacedBlock& block : blocks) {
    ++part->row_start[static_cast<std::size_t>(block.row) + 1];
    part->column.push_back(block.column);
    const double* B = A.block_at(block.source);
    for (std::size_t a = 0; a < m; ++a)
      for (std::size_t b = 0; b < m; ++b) part->values.push_back(block.transposed ? B[b * m + a] : B[a * m + b]);
  }
  for (std::size_t row = 0; row < part->global.size(); ++row) part->row_start[row + 1] += part->row_start[row];
  return Matrix(std::move(part));
}

}  // namespace plastron::algebra
