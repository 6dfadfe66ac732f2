#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/contact/active_set_steps.hpp>
#include <plastron/contact/pressing.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace plastron::contact {
namespace {

/// The coarsest thinning must have at least this number of violated bounds, to describe the zone.
constexpr double fewest = 100;
/// The search leaves the coarsest thinning when a step changes at most this part of the largest change there. One of
/// its rows stands for many rows of all bounds. Where rows are short (a narrow strip), all steps change equally few
/// bounds, and it is finished.
constexpr double coarse_share = 1.0 / 3;
/// The search leaves the other thinnings when at most this part of their active bounds changes. Values from 0.01 to 0.1
/// were measured. An unfinished thinning costs more steps among more bounds.
constexpr double few_changes = 0.02;

/// Bounds selected by hashes of their numbers. Their density is nearly uniform, and each thinning is a subset of the
/// next finer one.
class Thinning {
 public:
  explicit Thinning(const BoxProblem& problem)
      : first_(static_cast<std::uint64_t>(problem.load.layout()->first) *
               static_cast<std::uint64_t>(problem.load.block())) {}

  bool keeps(std::size_t i, int level) const {
    const std::uint64_t mask = (std::uint64_t{1} << (2 * level)) - 1;
    return (algebra::hash(first_ + i) & mask) == 0;
  }

  /// Returns `next` where the thinning keeps the bound, `set` elsewhere.
  ActiveSet among(const ActiveSet& set, const ActiveSet& next, int level) const {
    ActiveSet result = set;
    for (std::size_t i = 0; i < set.size(); ++i)
      if (keeps(i, level)) result[i] = next[i];
    return result;
  }

 private:
  std::uint64_t first_;
};

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

std::optional<SubproblemPoint> start_among_fewer(const BoxProblem& problem, PressedSubproblem& subproblems,
                                                 SubproblemPoint point, const Observer& observer, ActiveSet& set,
                                                 BoxSolution& solution) {
  const Thinning thinning(problem);
  const ActiveSet cold = set;
  Verdict verdict = judge(subproblems.box(), point, set);
  const auto broken = static_cast<double>(count_changes(problem, set, verdict.next));
  const int coarsest = broken > fewest ? static_cast<int>(std::log2(broken / fewest) / 2) : 0;
  int level = coarsest, steps = 0;
  double most_changes = 0;  // most changes in a step on the coarsest thinning, except the first
  std::optional<SubproblemPoint> at = std::move(point);
  while (level > 0 && !observer.wants_to_stop()) {
    Verdict kept = verdict;
    kept.next = thinning.among(set, verdict.next, level);
    const auto changes = static_cast<double>(count_changes(problem, set, kept.next));
    if (steps > 0 && level == coarsest) most_changes = std::max(most_changes, changes);
    const bool is_settled = level == coarsest
                                ? steps > 0 && changes <= coarse_share * most_changes
                                : changes <= few_changes * static_cast<double>(count_active(problem, kept.next));
    if (is_settled) {
      --level;
      continue;
    }
    ++steps;
    record(problem, std::move(*at), set, kept, observer, solution);
    set = kept.next;
    at = subproblems.solve(set);
    if (!at) break;
    verdict = judge(subproblems.box(), *at, set);
  }
  if (!at) set = cold;
  return at;
}

StepsEnd iterate_active_sets(const BoxProblem& problem, PressedSubproblem& subproblems,
                             std::optional<SubproblemPoint> point, const Settings& settings, const Observer& observer,
                             ActiveSet& set, BoxSolution& solution) {
  Progress progress;
  progress.is_lost(fingerprint(problem, set), std::numeric_limits<std::int64_t>::max());
  while (point) {
    const Verdict verdict = judge(subproblems.box(), *point, set);
    const bool crossed = bounds_cross(subproblems.box(), point->gap_noise);
    const std::int64_t changes = record(problem, std::move(*point), set, verdict, observer, solution);
    if (changes == 0 && crossed) return StepsEnd::lost;
    if (changes == 0) {
      solution.status = Status::solved;
      return StepsEnd::ended;
    }
    solution.status = Status::iteration_limit;
    if (static_cast<int>(solution.iterations.size()) >= settings.max_iterations) return StepsEnd::ended;
    solution.status = Status::interrupted;
    if (observer.wants_to_stop()) return StepsEnd::ended;
    set = verdict.next;
    if (progress.is_lost(fingerprint(problem, set), changes)) return StepsEnd::lost;
    point = subproblems.solve(set);
  }
  return StepsEnd::no_minimiser;
}

}  // namespace plastron::contact
