// Distribution of nodes over the ranks: every rank owns a contiguous range and sees some nodes of other ranks (ghosts).
// A layout is a distribution with the plan of the exchanges between owners and ghosts. Ranks without common ghosts do not
// communicate.
#pragma once
#include <mpi.h>

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace plastron::algebra {

using GlobalIndex = std::int64_t;
using LocalIndex = std::int32_t;

/// Local index i < owned is global node first + i; local index owned + j is global node ghosts[j].
struct Distribution {
  MPI_Comm comm = MPI_COMM_SELF;
  GlobalIndex first = 0;
  LocalIndex owned = 0;
  GlobalIndex global_size = 0;
  std::vector<GlobalIndex> ghosts{};  ///< ascending, owned by other ranks

  LocalIndex local_size() const { return owned + static_cast<LocalIndex>(ghosts.size()); }
  GlobalIndex global(LocalIndex i) const { return i < owned ? first + i : ghosts[static_cast<std::size_t>(i - owned)]; }
  bool owns(GlobalIndex node) const { return node >= first && node < first + owned; }
  bool sees(GlobalIndex node) const;  ///< whether this rank owns it or has it as a ghost
  /// Returns the local index of a node that this rank sees.
  LocalIndex local(GlobalIndex node) const;
  /// Adds the nodes that this rank does not see as ghosts. The local indices of ghosts change.
  void add_ghosts(std::vector<GlobalIndex> nodes);
};

/// Several values of one type as one item of MPI, so that MPI's 32-bit counts are counts of items.
class ItemType {
 public:
  ItemType(int values, MPI_Datatype of_value);
  ~ItemType();
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Items that come from or go to the neighbours, ordered by neighbour.
struct ItemsOfNeighbours {
  std::vector<int> count{}, start{};

  ItemsOfNeighbours() = default;
  explicit ItemsOfNeighbours(std::vector<int> counts);
  std::size_t total() const {
    return count.empty() ? 0 : static_cast<std::size_t>(start.back()) + static_cast<std::size_t>(count.back());
  }
};

/// The plan of the exchanges of one distribution, with their buffers. All ranks must make the exchanges one after
/// another in the same order.
class Exchange {
 public:
  /// Informs every owner which of its nodes the other ranks see (collective).
  explicit Exchange(const Distribution& nodes);
  ~Exchange();
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// Copies owners' values to ghosts; `local` contains `block` values per local node (collective).
  void to_ghosts(std::span<double> local, int block) const;
  /// Adds ghosts' values to the owners' values in the order of the ranks that see them, and sets them to zero
  /// (collective).
  void to_owners(std::span<double> local, int block) const;

  /// The ranks that own ghosts of this one or see its nodes, ascending.
  std::span<const int> neighbours() const { return neighbours_; }
  /// This rank's ghosts: sorted by owner, since every rank owns a contiguous range.
  const ItemsOfNeighbours& ghosts() const { return ghosts_; }
  /// Returns the items that the neighbours send here if this rank sends `out` (collective).
  ItemsOfNeighbours announced(const ItemsOfNeighbours& out) const;
  /// Sends items. `in` is the result of announced(out) (collective).
  void send(const void* out_items, const ItemsOfNeighbours& out, void* in_items, const ItemsOfNeighbours& in,
            MPI_Datatype item_type) const;

 private:
  std::size_t local_nodes() const { return static_cast<std::size_t>(owned_) + ghosts_.total(); }
  std::span<double> buffer(std::size_t values) const;
  MPI_Datatype item_of(int block) const;
  void find_neighbours(const Distribution& nodes);
  void find_seen(const Distribution& nodes);

  LocalIndex owned_;
  MPI_Comm graph_ = MPI_COMM_NULL;  ///< graph of the neighbours; null where no rank has ghosts
  std::vector<int> neighbours_{};
  ItemsOfNeighbours ghosts_{};                          ///< this rank's ghosts by owner
  ItemsOfNeighbours seen_by_{};                         ///< `seen_` by the rank that sees them
  std::vector<LocalIndex> seen_{};                      ///< nodes owned here that other ranks see
  mutable std::vector<double> buffer_{};                ///< values of `seen_`
  mutable std::map<int, const ItemType> item_types_{};  ///< item types by the number of values per node
};

/// All vectors and matrices on a layout share it and its plan. Another distribution is another layout.
class Layout : public Distribution {
 public:
  /// Makes the plan (collective).
  explicit Layout(Distribution nodes) : Distribution(std::move(nodes)), exchange_(*this) {}

  const Exchange& exchange() const { return exchange_; }

 private:
  Exchange exchange_;
};

}  // namespace plastron::algebra
