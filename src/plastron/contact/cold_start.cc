#include <plastron/contact/cold_start.hpp>

#include <plastron/algebra/hash.hpp>

#include <cmath>

namespace plastron::contact {
namespace {

/// Fewer broken bounds than this at the coarsest thinning say too little of the zone.
constexpr double fewest = 100;
/// A thinning is left when less than this part of its active bounds has changed: the next one begins elsewhere anyway.
constexpr double few_changes = 0.03;

/// Bounds taken by their numbers' hashes: about as many everywhere, and those of a thinning are among those of the next finer.
class Thinning {
 public:
  explicit Thinning(const BoxProblem& problem)
      : first_(static_cast<std::uint64_t>(problem.load.layout()->first) *
               static_cast<std::uint64_t>(problem.load.block())) {}

  bool keeps(std::size_t i, int level) const {
    const std::uint64_t mask = (std::uint64_t{1} << (2 * level)) - 1;
    return (algebra::hash(first_ + i) & mask) == 0;
  }

  /// `next` where the thinning keeps the bound, `set` elsewhere.
  ActiveSet among(const ActiveSet& set, const ActiveSet& next, int level) const {
    ActiveSet result = set;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (keeps(i, level)) result[i] = next[i];
    return result;
  }

 private:
  std::uint64_t first_;
};

}  // namespace

std::optional<SubproblemPoint> start_among_fewer(const BoxProblem& problem, PressedSubproblem& subproblems,
                                                 SubproblemPoint point, const Observer& observer, ActiveSet& set,
                                                 BoxSolution& solution) {
  const Thinning thinning(problem);
  const ActiveSet cold = set;
  Verdict verdict = judge(subproblems.box(), point, set);
  const auto broken = static_cast<double>(count_changes(problem, set, verdict.next));
  int level = broken > fewest ? static_cast<int>(std::log2(broken / fewest) / 2) : 0;
  std::optional<SubproblemPoint> at = std::move(point);
  while (level > 0) {
    Verdict kept = verdict;
    kept.next = thinning.among(set, verdict.next, level);
    const auto changes = static_cast<double>(count_changes(problem, set, kept.next));
    if (changes <= few_changes * static_cast<double>(count_active(problem, kept.next))) {
      --level;
      continue;
    }
    record(problem, std::move(*at), set, kept, observer, solution);
    if (observer.wants_to_stop()) break;
    set = kept.next;
    at = subproblems.solve(set);
    if (!at) break;
    verdict = judge(subproblems.box(), *at, set);
  }
  if (!at) set = cold;
  return at;
}

}  // namespace plastron::contact
