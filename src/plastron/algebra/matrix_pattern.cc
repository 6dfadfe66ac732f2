// The pattern of a Matrix: the blocks that elements couple, here and on other ranks.
#include <fmt/core.h>
#include <plastron/algebra/agreement.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "matrix_storage.hpp"

namespace plastron::algebra {
namespace {

using Coupling = std::pair<GlobalIndex, GlobalIndex>;  // row and column, row <= column

/// Columns by compressed rows.
struct Rows {
  std::vector<std::int64_t> start{0};
  std::vector<LocalIndex> column{};

  std::span<const LocalIndex> of(LocalIndex row) const {
    const auto r = static_cast<std::size_t>(row);
    return {column.data() + start[r], column.data() + start[r + 1]};
  }
  void end_row() { start.push_back(static_cast<std::int64_t>(column.size())); }
};

void check_nodes(const Connectivity& elements, LocalIndex nodes) {
  for (const LocalIndex node : elements.nodes)
    if (node < 0 || node >= nodes)
      throw std::out_of_range(fmt::format("element node {} is not in 0..{}", node, nodes - 1));
}

// Elements that touch each local node, as compressed rows.
struct ElementsOfNodes {
  std::vector<std::size_t> start;
  std::vector<std::size_t> element;
};

ElementsOfNodes elements_of_nodes(std::size_t nodes, const Connectivity& elements) {
  ElementsOfNodes lists{std::vector<std::size_t>(nodes + 1, 0), {}};
  for (const LocalIndex node : elements.nodes) ++lists.start[static_cast<std::size_t>(node) + 1];
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.element.resize(elements.nodes.size());
  auto next = lists.start;
  for (std::size_t e = 0; e < elements.elements(); ++e)
    for (const LocalIndex node : elements.element(e)) lists.element[next[static_cast<std::size_t>(node)]++] = e;
  return lists;
}

// Returns the rows that this rank's elements give to its local nodes, with columns ascending in global numbering. Owned
// rows always have a diagonal.
Rows rows_of_elements(const Layout& layout, const Connectivity& elements) {
  const auto nodes = static_cast<std::size_t>(layout.local_size());
  const ElementsOfNodes lists = elements_of_nodes(nodes, elements);
  std::vector<GlobalIndex> global(nodes);
  for (std::size_t i = 0; i < nodes; ++i) global[i] = layout.global(static_cast<LocalIndex>(i));
  std::vector<std::size_t> last_row(nodes, nodes);  // the last row that took a node
  Rows rows;
  for (std::size_t row = 0; row < nodes; ++row) {
    const auto take = [&](LocalIndex node) {
      const auto n = static_cast<std::size_t>(node);
      if (last_row[n] == row || global[n] < global[row]) return;
      last_row[n] = row;
      rows.column.push_back(node);
    };
    if (row < static_cast<std::size_t>(layout.owned)) take(static_cast<LocalIndex>(row));
    for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k)
      for (const LocalIndex node : elements.element(lists.element[k])) take(node);
    std::sort(rows.column.begin() + rows.start.back(), rows.column.end(), [&](LocalIndex a, LocalIndex b) {
      return global[static_cast<std::size_t>(a)] < global[static_cast<std::size_t>(b)];
    });
    rows.end_row();
  }
  return rows;
}

// Returns the number of blocks in the rows of each neighbour's ghosts.
ItemsOfNeighbours blocks_of_ghosts(const Layout& layout, const Rows& rows) {
  std::vector<int> counts;
  LocalIndex ghost = layout.owned;
  for (const int ghosts : layout.exchange().ghosts().count) {
    const auto begin = rows.start[static_cast<std::size_t>(ghost)];
    ghost += ghosts;
    counts.push_back(static_cast<int>(rows.start[static_cast<std::size_t>(ghost)] - begin));
  }
  return ItemsOfNeighbours(std::move(counts));
}

// Sends the places of the blocks in rows of ghosts to their owners, and sets A's shipments. Returns the received
// places, ordered by neighbour (collective).
std::vector<Coupling> ship_places(MatrixStorage& A, const Rows& rows) {
  const Layout& layout = *A.layout;
  A.outgoing = blocks_of_ghosts(layout, rows);
  A.incoming = layout.exchange().announced(A.outgoing);
  std::vector<GlobalIndex> out, in(2 * A.incoming.total());
  out.reserve(2 * A.outgoing.total());
  for (LocalIndex row = layout.owned; row < layout.local_size(); ++row)
    for (const LocalIndex column : rows.of(row)) out.insert(out.end(), {layout.global(row), layout.global(column)});
  const ItemType place(2, MPI_INT64_T);
  layout.exchange().send(out.data(), A.outgoing, in.data(), A.incoming, place.get());
  std::vector<Coupling> received;
  received.reserve(A.incoming.total());
  for (std::size_t k = 0; k < in.size(); k += 2) received.emplace_back(in[k], in[k + 1]);
  return received;
}

// Returns the layout itself where every rank sees all columns of its rows (collective).
std::shared_ptr<const Layout> widened(const std::shared_ptr<const Layout>& layout,
                                      const std::vector<Coupling>& received) {
  std::vector<GlobalIndex> unseen;
  for (const auto& [row, column] : received)
    if (!layout->sees(column)) unseen.push_back(column);
  if (sum_over_ranks(static_cast<std::int64_t>(unseen.size()), layout->comm) == 0) return layout;
  Distribution wide = *layout;
  wide.add_ghosts(std::move(unseen));
  return std::make_shared<const Layout>(std::move(wide));
}

// Sorts columns from `begin` on in ascending global order, and removes duplicates.
void order_columns(const MatrixStorage& A, std::size_t begin, std::vector<LocalIndex>& columns) {
  const auto first = columns.begin() + static_cast<std::ptrdiff_t>(begin);
  std::sort(first, columns.end(), [&](LocalIndex a, LocalIndex b) {
    return A.global[static_cast<std::size_t>(a)] < A.global[static_cast<std::size_t>(b)];
  });
  columns.erase(std::unique(first, columns.end()), columns.end());
}

// Returns the rows over the nodes of `wide`: rows of this rank's elements, and for owned rows also the received places.
Rows joined_rows(const MatrixStorage& A, const Rows& rows, std::vector<Coupling> received) {
  std::ranges::sort(received);
  auto next = received.cbegin();
  Rows joined;
  joined.column.reserve(rows.column.size());
  LocalIndex row = 0;  // row of the layout
  for (LocalIndex wide_row = 0; wide_row < A.wide->local_size(); ++wide_row) {
    const std::size_t begin = joined.column.size();
    if (row < A.layout->local_size() && A.in_wide(row) == wide_row)
      for (const LocalIndex column : rows.of(row++)) joined.column.push_back(A.in_wide(column));
    const std::size_t own = joined.column.size();
    for (; next != received.cend() && next->first == A.global[static_cast<std::size_t>(wide_row)]; ++next)
      joined.column.push_back(A.wide->local(next->second));
    if (joined.column.size() > own) order_columns(A, begin, joined.column);
    joined.end_row();
  }
  return joined;
}

}  // namespace

void build_pattern(MatrixStorage& A, const Connectivity& elements) {
  in_agreement(A.layout->comm, [&] { check_nodes(elements, A.layout->local_size()); });
  Rows rows = rows_of_elements(*A.layout, elements);
  const std::vector<Coupling> received = ship_places(A, rows);
  A.wide = widened(A.layout, received);
  for (const GlobalIndex ghost : A.layout->ghosts) A.ghost_in_wide.push_back(A.wide->local(ghost));
  for (LocalIndex i = 0; i < A.wide->local_size(); ++i) A.global.push_back(A.wide->global(i));
  if (A.wide != A.layout || !received.empty()) rows = joined_rows(A, rows, received);
  A.row_start = std::move(rows.start);
  A.column = std::move(rows.column);
  for (const auto& [row, column] : received) A.target.push_back(A.find(A.wide->local(row), column));
}

}  // namespace plastron::algebra
