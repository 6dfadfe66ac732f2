#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/exchange.hpp>

#include <algorithm>
#include <functional>
#include <numeric>

namespace plastron::algebra {
namespace {

std::vector<int> count_by_owner(const Layout& layout, int ranks) {
  const GlobalIndex end = layout.first + layout.owned;
  std::vector<GlobalIndex> ends(static_cast<std::size_t>(ranks));
  MPI_Allgather(&end, 1, MPI_INT64_T, ends.data(), 1, MPI_INT64_T, layout.comm);
  std::vector<int> counts(static_cast<std::size_t>(ranks), 0);
  for (const GlobalIndex ghost : layout.ghosts)
    ++counts[static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), ghost) - ends.begin())];
  return counts;
}

// For the assertion below.
[[maybe_unused]] bool ghosts_are_ascending_and_others(const Layout& layout) {
  const auto is_wrong = [&](GlobalIndex ghost) {
    return ghost < 0 || ghost >= layout.global_size || (ghost >= layout.first && ghost < layout.first + layout.owned);
  };
  return std::ranges::adjacent_find(layout.ghosts, std::ranges::greater_equal()) == layout.ghosts.end() &&
         std::ranges::none_of(layout.ghosts, is_wrong);
}

std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offsets(counts.size(), 0);
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  return offsets;
}

// MPI_Alltoallv of one item of `type` per count.
void all_to_all(const void* out, const std::vector<int>& out_counts, void* in, const std::vector<int>& in_counts,
                MPI_Datatype type, MPI_Comm comm) {
  MPI_Alltoallv(out, out_counts.data(), offsets_of(out_counts).data(), type, in, in_counts.data(),
                offsets_of(in_counts).data(), type, comm);
}

// `block` doubles as one MPI item.
struct BlockType {
  explicit BlockType(int block) {
    MPI_Type_contiguous(block, MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
  }
  ~BlockType() { MPI_Type_free(&type); }
  BlockType(const BlockType&) = delete;
  BlockType& operator=(const BlockType&) = delete;
  MPI_Datatype type = MPI_DATATYPE_NULL;
};

}  // namespace

Exchange::Exchange(const Layout& layout) : comm_(layout.comm), owned_(layout.owned) {
  PLASTRON_ASSERT(ghosts_are_ascending_and_others(layout), layout.first, layout.owned, layout.global_size,
                  layout.ghosts.size());
  std::int64_t ghosts = static_cast<std::int64_t>(layout.ghosts.size());
  MPI_Allreduce(MPI_IN_PLACE, &ghosts, 1, MPI_INT64_T, MPI_SUM, comm_);
  alone_ = ghosts == 0;
  int ranks = 1;
  MPI_Comm_size(comm_, &ranks);
  ghosts_of_rank_.assign(static_cast<std::size_t>(ranks), 0);
  seen_by_rank_ = ghosts_of_rank_;
  if (alone_) return;
  ghosts_of_rank_ = count_by_owner(layout, ranks);
  MPI_Alltoall(ghosts_of_rank_.data(), 1, MPI_INT, seen_by_rank_.data(), 1, MPI_INT, comm_);
  std::vector<GlobalIndex> wanted(std::accumulate(seen_by_rank_.begin(), seen_by_rank_.end(), std::size_t{0}));
  all_to_all(layout.ghosts.data(), ghosts_of_rank_, wanted.data(), seen_by_rank_, MPI_INT64_T, comm_);
  seen_.resize(wanted.size());
  std::transform(wanted.begin(), wanted.end(), seen_.begin(),
                 [&](GlobalIndex node) { return static_cast<LocalIndex>(node - layout.first); });
}

std::size_t Exchange::local_nodes() const {
  return static_cast<std::size_t>(owned_) +
         std::accumulate(ghosts_of_rank_.begin(), ghosts_of_rank_.end(), std::size_t{0});
}

void Exchange::to_ghosts(std::span<double> local, int block) const {
  PLASTRON_ASSERT(local.size() == local_nodes() * static_cast<std::size_t>(block), local.size(), local_nodes(), block);
  if (alone_) return;
  const auto width = static_cast<std::size_t>(block);
  std::vector<double> out(seen_.size() * width);
  for (std::size_t k = 0; k < seen_.size(); ++k)
    std::copy_n(local.begin() + seen_[k] * block, width, out.begin() + static_cast<std::ptrdiff_t>(k * width));
  const BlockType item(block);
  all_to_all(out.data(), seen_by_rank_, local.data() + owned_ * block, ghosts_of_rank_, item.type, comm_);
}

void Exchange::to_owners(std::span<double> local, int block) const {
  PLASTRON_ASSERT(local.size() == local_nodes() * static_cast<std::size_t>(block), local.size(), local_nodes(), block);
  if (alone_) return;
  const auto width = static_cast<std::size_t>(block);
  std::vector<double> in(seen_.size() * width);
  const BlockType item(block);
  all_to_all(local.data() + owned_ * block, ghosts_of_rank_, in.data(), seen_by_rank_, item.type, comm_);
  for (std::size_t k = 0; k < seen_.size(); ++k)
    for (std::size_t c = 0; c < width; ++c) local[static_cast<std::size_t>(seen_[k]) * width + c] += in[k * width + c];
  std::fill(local.begin() + owned_ * block, local.end(), 0.0);
}

}  // namespace plastron::algebra
