// Distribution of nodes over the ranks: every rank owns a contiguous range and sees some nodes of other ranks (ghosts).
#pragma once
#include <mpi.h>

#include <cstdint>
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

}  // namespace plastron::algebra
