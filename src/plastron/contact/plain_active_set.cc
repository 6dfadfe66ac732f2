#include <plastron/contact/plain_active_set.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <limits>
#include <set>

namespace plastron::contact {
namespace {

/// The plain method ends after this number of iterations without a new minimum of changes. It is large: from a cold
/// start the method may move the free boundary by one element in each step.
constexpr int patience_with_changes = 50;

// Detects whether the plain method still makes progress.
class Progress {
 public:
  bool is_lost(std::uint64_t next_set, std::int64_t changes) {
    const bool seen_before = !seen_.insert(next_set).second;
    since_fewer_changes_ = changes < fewest_changes_ ? 0 : since_fewer_changes_ + 1;
    fewest_changes_ = std::min(fewest_changes_, changes);
    return seen_before || since_fewer_changes_ > patience_with_changes;
  }

 private:
  std::set<std::uint64_t> seen_{};
  std::int64_t fewest_changes_ = std::numeric_limits<std::int64_t>::max();
  int since_fewer_changes_ = 0;
};

}  // namespace

PlainEnd iterate_active_sets(const BoxProblem& problem, PressedSubproblem& subproblems,
                             std::optional<SubproblemPoint> point, const Settings& settings, const Observer& observer,
                             ActiveSet& set, BoxSolution& solution) {
  Progress progress;
  progress.is_lost(fingerprint(problem, set), std::numeric_limits<std::int64_t>::max());
  while (point) {
    const Verdict verdict = judge(subproblems.box(), *point, set);
    const bool crossed = bounds_cross(subproblems.box(), point->gap_noise);
    const std::int64_t changes = record(problem, std::move(*point), set, verdict, observer, solution);
    if (changes == 0 && crossed) return PlainEnd::lost;
    if (changes == 0) {
      solution.status = Status::solved;
      return PlainEnd::ended;
    }
    solution.status = Status::iteration_limit;
    if (static_cast<int>(solution.iterations.size()) >= settings.max_iterations) return PlainEnd::ended;
    solution.status = Status::interrupted;
    if (observer.wants_to_stop()) return PlainEnd::ended;
    set = verdict.next;
    if (progress.is_lost(fingerprint(problem, set), changes)) return PlainEnd::lost;
    point = subproblems.solve(set);
  }
  return PlainEnd::no_minimiser;
}

}  // namespace plastron::contact
