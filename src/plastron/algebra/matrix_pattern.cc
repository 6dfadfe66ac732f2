// The pattern of a Matrix: which blocks elements couple, here and on other ranks.
#include <fmt/core.h>
#include <plastron/algebra/agreement.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "block_exchange.hpp"
#include "matrix_storage.hpp"

namespace plastron::algebra {
namespace {

using Coupling = std::pair<GlobalIndex, GlobalIndex>;  // row and column, row <= column

void check_nodes(const Connectivity& elements, LocalIndex nodes) {
  for (const LocalIndex node : elements.nodes)
    if (node < 0 || node >= nodes)
      throw std::out_of_range(fmt::format("element node {} is not in 0..{}", node, nodes - 1));
}

// Couplings in rows of other ranks, ascending, so that each owner's follow one another.
std::vector<Coupling> couplings_of_others(const Layout& layout, const Connectivity& elements) {
  std::vector<Coupling> couplings;
  for (std::size_t e = 0; e < elements.elements(); ++e)
    for (const LocalIndex p : elements.element(e)) {
      if (p < layout.owned) continue;
      for (const LocalIndex q : elements.element(e))
        if (layout.global(p) <= layout.global(q)) couplings.emplace_back(layout.global(p), layout.global(q));
    }
  std::ranges::sort(couplings);
  couplings.erase(std::unique(couplings.begin(), couplings.end()), couplings.end());
  return couplings;
}

// Couplings of rows owned here that other ranks' elements make, ascending (collective).
std::vector<Coupling> couplings_from_others(const Layout& layout, const Connectivity& elements) {
  const Exchange exchange(layout);
  const auto couplings = couplings_of_others(layout, elements);
  TravellingBlocks out;
  auto next = couplings.begin();
  std::size_t ghost = 0;
  for (const int ghosts : exchange.ghosts_of_rank()) {
    ghost += static_cast<std::size_t>(ghosts);
    const auto begin = next;
    for (; next != couplings.end() && ghost > 0 && next->first <= layout.ghosts[ghost - 1]; ++next)
      out.places.insert(out.places.end(), {next->first, next->second});
    out.blocks_of_rank.push_back(static_cast<int>(next - begin));
  }
  const TravellingBlocks in = exchange_blocks(out, 0, layout.comm);
  std::vector<Coupling> received;
  for (std::size_t k = 0; k < in.places.size(); k += 2) received.emplace_back(in.places[k], in.places[k + 1]);
  std::ranges::sort(received);
  received.erase(std::unique(received.begin(), received.end()), received.end());
  return received;
}

std::shared_ptr<const Layout> widen(const Layout& layout, const std::vector<Coupling>& received) {
  auto wide = std::make_shared<Layout>(layout);
  for (const auto& [row, column] : received)
    if (column < layout.first || column >= layout.first + layout.owned) wide->ghosts.push_back(column);
  std::ranges::sort(wide->ghosts);
  wide->ghosts.erase(std::unique(wide->ghosts.begin(), wide->ghosts.end()), wide->ghosts.end());
  return wide;
}

LocalIndex local_in(const Layout& layout, GlobalIndex node) {
  if (node >= layout.first && node < layout.first + layout.owned) return static_cast<LocalIndex>(node - layout.first);
  const auto found = std::ranges::lower_bound(layout.ghosts, node);
  return layout.owned + static_cast<LocalIndex>(found - layout.ghosts.begin());
}

// Lists by node of `wide`, as compressed rows: the elements that touch it.
struct ElementsOfNodes {
  std::vector<std::size_t> start;
  std::vector<std::size_t> element;
};

ElementsOfNodes elements_of_nodes(const Matrix::Storage& A, const Connectivity& elements) {
  ElementsOfNodes lists{std::vector<std::size_t>(A.global.size() + 1, 0), {}};
  for (const LocalIndex node : elements.nodes) ++lists.start[static_cast<std::size_t>(A.in_wide(node)) + 1];
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.element.resize(elements.nodes.size());
  auto next = lists.start;
  for (std::size_t e = 0; e < elements.elements(); ++e)
    for (const LocalIndex node : elements.element(e))
      lists.element[next[static_cast<std::size_t>(A.in_wide(node))]++] = e;
  return lists;
}

// The rows one after the other. `last_row[j]` remembers for which row node j was taken last.
void fill_rows(Matrix::Storage& A, const Connectivity& elements, const std::vector<Coupling>& received) {
  const ElementsOfNodes lists = elements_of_nodes(A, elements);
  std::vector<std::size_t> last_row(A.global.size(), A.global.size());
  auto next = received.begin();
  A.row_start.assign(1, 0);
  for (std::size_t row = 0; row < A.global.size(); ++row) {
    const auto take = [&](LocalIndex node) {
      const auto n = static_cast<std::size_t>(node);
      if (last_row[n] == row || A.global[n] < A.global[row]) return;
      last_row[n] = row;
      A.column.push_back(node);
    };
    take(static_cast<LocalIndex>(row));
    for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k)
      for (const LocalIndex node : elements.element(lists.element[k])) take(A.in_wide(node));
    for (; next != received.end() && next->first == A.global[row]; ++next) take(local_in(*A.wide, next->second));
    std::sort(A.column.begin() + A.row_start.back(), A.column.end(), [&](LocalIndex a, LocalIndex b) {
      return A.global[static_cast<std::size_t>(a)] < A.global[static_cast<std::size_t>(b)];
    });
    A.row_start.push_back(static_cast<std::int64_t>(A.column.size()));
  }
}

}  // namespace

void build_pattern(Matrix::Storage& A, const Connectivity& elements) {
  in_agreement(A.layout->comm, [&] { check_nodes(elements, A.layout->local_size()); });
  int ranks = 1;
  MPI_Comm_size(A.layout->comm, &ranks);
  const auto received = ranks == 1 ? std::vector<Coupling>{} : couplings_from_others(*A.layout, elements);
  A.wide = ranks == 1 ? A.layout : widen(*A.layout, received);
  A.exchange = std::make_shared<const Exchange>(*A.wide);
  for (const GlobalIndex ghost : A.layout->ghosts) A.ghost_in_wide.push_back(local_in(*A.wide, ghost));
  for (LocalIndex i = 0; i < A.wide->local_size(); ++i) A.global.push_back(A.wide->global(i));
  fill_rows(A, elements, received);
}

}  // namespace plastron::algebra
