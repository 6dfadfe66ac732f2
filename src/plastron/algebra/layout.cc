#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/layout.hpp>

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace plastron::algebra {

bool Distribution::sees(GlobalIndex node) const { return owns(node) || std::ranges::binary_search(ghosts, node); }

LocalIndex Distribution::local(GlobalIndex node) const {
  PLASTRON_ASSERT(sees(node), node, first, owned, ghosts.size());
  if (owns(node)) return static_cast<LocalIndex>(node - first);
  return owned + static_cast<LocalIndex>(std::ranges::lower_bound(ghosts, node) - ghosts.begin());
}

void Distribution::add_ghosts(std::vector<GlobalIndex> nodes) {
  std::erase_if(nodes, [&](GlobalIndex node) { return owns(node); });
  nodes.insert(nodes.end(), ghosts.begin(), ghosts.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  ghosts = std::move(nodes);
}

namespace {

bool mpi_runs() {
  int has_ended = 0;
  MPI_Finalized(&has_ended);
  return !has_ended;
}

/// Returns the number of this rank's ghosts that each rank owns (collective).
std::vector<int> ghosts_by_owner(const Distribution& nodes) {
  int ranks = 1;
  MPI_Comm_size(nodes.comm, &ranks);
  const GlobalIndex end = nodes.first + nodes.owned;
  std::vector<GlobalIndex> ends(static_cast<std::size_t>(ranks));
  MPI_Allgather(&end, 1, MPI_INT64_T, ends.data(), 1, MPI_INT64_T, nodes.comm);
  std::vector<int> counts(static_cast<std::size_t>(ranks), 0);
  for (const GlobalIndex ghost : nodes.ghosts)
    ++counts[static_cast<std::size_t>(std::ranges::upper_bound(ends, ghost) - ends.begin())];
  return counts;
}

// Used by the assertion below.
[[maybe_unused]] bool ghosts_are_ascending_and_others(const Distribution& nodes) {
  const auto is_wrong = [&](GlobalIndex ghost) { return ghost < 0 || ghost >= nodes.global_size || nodes.owns(ghost); };
  return std::ranges::adjacent_find(nodes.ghosts, std::ranges::greater_equal()) == nodes.ghosts.end() &&
         std::ranges::none_of(nodes.ghosts, is_wrong);
}

std::vector<int> starts_of(const std::vector<int>& counts) {
  std::vector<int> starts(counts.size(), 0);
  std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  return starts;
}

}  // namespace

ItemType::ItemType(int values, MPI_Datatype of_value) {
  MPI_Type_contiguous(values, of_value, &type_);
  MPI_Type_commit(&type_);
}

ItemType::~ItemType() {
  if (mpi_runs()) MPI_Type_free(&type_);
}

ItemsOfNeighbours::ItemsOfNeighbours(std::vector<int> counts) : count(std::move(counts)), start(starts_of(count)) {}

Exchange::Exchange(const Distribution& nodes) : owned_(nodes.owned) {
  PLASTRON_ASSERT(ghosts_are_ascending_and_others(nodes), nodes.first, nodes.owned, nodes.global_size,
                  nodes.ghosts.size());
  std::int64_t ghosts = static_cast<std::int64_t>(nodes.ghosts.size());
  MPI_Allreduce(MPI_IN_PLACE, &ghosts, 1, MPI_INT64_T, MPI_SUM, nodes.comm);
  if (ghosts == 0) return;
  find_neighbours(nodes);
  find_seen(nodes);
}

// Each rank frees the communicator of the graph by itself. No rank waits for others.
Exchange::~Exchange() {
  if (graph_ != MPI_COMM_NULL && mpi_runs()) MPI_Comm_free(&graph_);
}

// Each rank learns once from all others whether they see its nodes. From then on only neighbours communicate.
void Exchange::find_neighbours(const Distribution& nodes) {
  const std::vector<int> owned_by = ghosts_by_owner(nodes);
  std::vector<int> seen_by(owned_by.size());
  MPI_Alltoall(owned_by.data(), 1, MPI_INT, seen_by.data(), 1, MPI_INT, nodes.comm);
  std::vector<int> ghosts, seen;
  for (std::size_t rank = 0; rank < owned_by.size(); ++rank) {
    if (owned_by[rank] == 0 && seen_by[rank] == 0) continue;
    neighbours_.push_back(static_cast<int>(rank));
    ghosts.push_back(owned_by[rank]);
    seen.push_back(seen_by[rank]);
  }
  ghosts_ = ItemsOfNeighbours(std::move(ghosts));
  seen_by_ = ItemsOfNeighbours(std::move(seen));
  const auto degree = static_cast<int>(neighbours_.size());
  constexpr int keep_ranks = 0;
  MPI_Dist_graph_create_adjacent(nodes.comm, degree, neighbours_.data(), MPI_UNWEIGHTED, degree, neighbours_.data(),
                                 MPI_UNWEIGHTED, MPI_INFO_NULL, keep_ranks, &graph_);
}

void Exchange::find_seen(const Distribution& nodes) {
  std::vector<GlobalIndex> wanted(seen_by_.total());
  send(nodes.ghosts.data(), ghosts_, wanted.data(), seen_by_, MPI_INT64_T);
  seen_.resize(wanted.size());
  std::ranges::transform(wanted, seen_.begin(),
                         [&](GlobalIndex node) { return static_cast<LocalIndex>(node - nodes.first); });
}

ItemsOfNeighbours Exchange::announced(const ItemsOfNeighbours& out) const {
  std::vector<int> counts(neighbours_.size(), 0);
  if (graph_ != MPI_COMM_NULL) MPI_Neighbor_alltoall(out.count.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, graph_);
  return ItemsOfNeighbours(std::move(counts));
}

void Exchange::send(const void* out_items, const ItemsOfNeighbours& out, void* in_items, const ItemsOfNeighbours& in,
                    MPI_Datatype item_type) const {
  PLASTRON_ASSERT(out.count.size() == neighbours_.size() && in.count.size() == neighbours_.size(), out.count.size(),
                  in.count.size(), neighbours_.size());
  if (graph_ == MPI_COMM_NULL) return;
  MPI_Neighbor_alltoallv(out_items, out.count.data(), out.start.data(), item_type, in_items, in.count.data(),
                         in.start.data(), item_type, graph_);
}

std::span<double> Exchange::buffer(std::size_t values) const {
  if (buffer_.size() < values) buffer_.resize(values);
  return std::span(buffer_).first(values);
}

MPI_Datatype Exchange::item_of(int block) const {
  return item_types_.try_emplace(block, block, MPI_DOUBLE).first->second.get();
}

void Exchange::to_ghosts(std::span<double> local, int block) const {
  PLASTRON_ASSERT(local.size() == local_nodes() * static_cast<std::size_t>(block), local.size(), local_nodes(), block);
  if (graph_ == MPI_COMM_NULL) return;
  const auto width = static_cast<std::size_t>(block);
  const auto out = buffer(seen_.size() * width);
  for (std::size_t k = 0; k < seen_.size(); ++k)
    std::copy_n(&local[static_cast<std::size_t>(seen_[k]) * width], width, &out[k * width]);
  send(out.data(), seen_by_, local.data() + static_cast<std::size_t>(owned_) * width, ghosts_, item_of(block));
}

void Exchange::to_owners(std::span<double> local, int block) const {
  PLASTRON_ASSERT(local.size() == local_nodes() * static_cast<std::size_t>(block), local.size(), local_nodes(), block);
  if (graph_ == MPI_COMM_NULL) return;
  const auto width = static_cast<std::size_t>(block);
  const auto of_ghosts = local.subspan(static_cast<std::size_t>(owned_) * width);
  const auto in = buffer(seen_.size() * width);
  send(of_ghosts.data(), ghosts_, in.data(), seen_by_, item_of(block));
  for (std::size_t k = 0; k < seen_.size(); ++k)
    for (std::size_t c = 0; c < width; ++c) local[static_cast<std::size_t>(seen_[k]) * width + c] += in[k * width + c];
  std::ranges::fill(of_ghosts, 0.0);
}

}  // namespace plastron::algebra
