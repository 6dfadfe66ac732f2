// Callbacks on the progress of a computation.
#pragma once
#include <plastron/computation/result.hpp>

#include <functional>
#include <string_view>

namespace plastron::computation {

/// Receives progress; every member may be empty. Called on every rank.
struct Observer {
  std::function<void(int level, std::string_view phase)> phase{};
  std::function<void(int level, const contact::Iteration&)> iteration{};
  std::function<void(int level, const Level&)> level{};
  std::function<void(std::string_view text)> warning{};  ///< called as soon as it is known; the result has it too
  /// Solution of every level, which does not exist afterwards.
  std::function<void(int level, const Solution&)> solution{};
  std::function<void(const HistoryEntry&, const Solution&)> instant{};  ///< every instant, where there are steps
  /// Called between active-set iterations and between meshes: true ends the computation with status interrupted. It
  /// must be empty on all ranks or on none. If one rank returns true, all stop.
  std::function<bool()> stop{};
};

/// Whether any rank wants to stop (collective).
inline bool wants_to_stop(const Observer& observer, MPI_Comm comm) {
  return observer.stop && algebra::sum_over_ranks(std::int64_t{observer.stop()}, comm) > 0;
}

}  // namespace plastron::computation
