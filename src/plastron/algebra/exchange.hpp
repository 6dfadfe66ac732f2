// Carries nodal values between the ranks that own nodes and those that see them as ghosts.
#pragma once
#include <plastron/algebra/layout.hpp>

#include <span>
#include <vector>

namespace plastron::algebra {

class Exchange {
 public:
  /// Tells every owner which of its nodes the other ranks see (collective).
  explicit Exchange(const Layout& layout);

  /// Owners' values -> ghosts; `local` holds `block` values per local node (collective).
  void to_ghosts(std::span<double> local, int block) const;
  /// Ghosts' values are added to their owners' and set to zero (collective).
  void to_owners(std::span<double> local, int block) const;

  /// How many ghosts each rank owns; the ghosts are sorted by owner, since every rank owns a contiguous range.
  const std::vector<int>& ghosts_of_rank() const { return ghosts_of_rank_; }

 private:
  std::size_t local_nodes() const;

  MPI_Comm comm_;
  LocalIndex owned_;
  bool alone_;                       ///< no rank has ghosts
  std::vector<int> ghosts_of_rank_;  ///< this rank's ghosts, counted by owner
  std::vector<int> seen_by_rank_;    ///< this rank's nodes, counted by the rank that sees them
  std::vector<LocalIndex> seen_;     ///< those nodes, rank after rank
};

}  // namespace plastron::algebra
