#include <plastron/contact/dual_ascent.hpp>
#include <plastron/contact/pressing_search.hpp>
#include <plastron/contact/projected_search.hpp>
#include <plastron/contact/proximal_point.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace plastron::contact {
namespace {

using algebra::Vector;

/// A feasible point with its gradient A z - b and its energy.
struct Feasible {
  Vector z{};
  Vector gradient{};
  double energy = 0;
};

Feasible evaluate(const BoxProblem& problem, Vector z) {
  Feasible here{.z = std::move(z), .gradient = Vector(problem.load.layout(), problem.load.block())};
  problem.apply(here.z, here.gradient);
  algebra::axpy(-1, problem.load, here.gradient);
  here.energy = 0.5 * (algebra::dot(here.z, here.gradient) - algebra::dot(here.z, problem.load));
  return here;
}

/// A step from z to P(z + t (target - z)), and the change of energy g's + s'As/2. This form keeps the digits that the
/// difference of two energies would lose.
struct Step {
  Vector z{};
  double slope = 0;
  double energy_change = 0;
};

Step projected_step(const BoxProblem& problem, const Feasible& from, const Vector& target, double t) {
  Step step{.z = from.z};
  for (std::size_t i = 0; i < step.z.owned().size(); ++i)
    step.z.owned()[i] += t * (target.owned()[i] - from.z.owned()[i]);
  step.z = project(problem, std::move(step.z));
  Vector s = step.z;
  algebra::axpy(-1, from.z, s);
  s.update_ghosts();
  Vector As(s.layout(), s.block());
  problem.apply(s, As);
  step.slope = algebra::dot(from.gradient, s);
  step.energy_change = step.slope + 0.5 * algebra::dot(s, As);
  return step;
}

/// Returns the lowest of the steps t = 1, 1/2, 1/4, ... around the first that passes Armijo's test. An operator
/// application is cheap compared with a factorisation, so one further step is tried. Nothing if no step lowers the
/// energy.
std::optional<Vector> projected_line_search(const BoxProblem& problem, const Feasible& from, const Vector& target) {
  constexpr double fraction_of_slope = 1e-4;
  constexpr int most_halvings = 50;
  std::optional<Step> best;
  double t = 1;
  for (int halvings = 0; halvings < most_halvings; ++halvings, t /= 2) {
    Step step = projected_step(problem, from, target, t);
    const bool acceptable = step.slope < 0 && step.energy_change <= fraction_of_slope * step.slope;
    if (best && !(acceptable && step.energy_change < best->energy_change)) break;
    if (acceptable) best = std::move(step);
  }
  if (!best) return {};
  return std::move(best->z);
}

/// Returns the minimiser's set with one unknown released: the one whose release promises the largest energy decrease,
/// m^2 / 2 A_ii.
ActiveSet release_one(const BoxProblem& problem, const ActiveSet& held, const ActiveSet& released,
                      const Vector& multiplier, const Vector& diagonal) {
  const MPI_Comm comm = problem.load.layout()->comm;
  const auto first = static_cast<double>(problem.load.layout()->first) * problem.load.block();
  double most = -1;
  double chosen = std::numeric_limits<double>::infinity();
  const auto promise = [&](std::size_t i) {
    const double m = multiplier.owned()[i];
    return held[i] == released[i] ? -1.0 : m * m / diagonal.owned()[i];
  };
  for (std::size_t i = 0; i < held.size(); ++i) most = std::max(most, promise(i));
  most = algebra::max_over_ranks(most, comm);
  for (std::size_t i = held.size(); i-- > 0;)
    if (promise(i) >= most) chosen = first + static_cast<double>(i);
  chosen = algebra::min_over_ranks(chosen, comm);
  ActiveSet one = held;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (first + static_cast<double>(i) == chosen) one[i] = Activity::free;
  return one;
}

class ProjectedSearch {
 public:
  ProjectedSearch(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                  const Observer& observer, BoxSolution& solution)
      : problem_(problem), subproblems_(subproblems), settings_(settings), observer_(observer), solution_(solution) {
    here_ = evaluate(problem_, project(problem_, solution_.z));
    held_ = everything_at_bounds(problem_, here_.z);
  }

  Status run() {
    while (static_cast<int>(solution_.iterations.size()) < settings_.max_iterations) {
      if (observer_.wants_to_stop()) return Status::interrupted;
      const auto point = subproblems_.solve(held_);
      if (!point && !released_.empty()) {
        held_ = release_one(problem_, held_at_minimiser_, released_, solution_.multiplier, subproblems_.diagonal());
        released_.clear();
        continue;
      }
      if (!point) return after_a_first_step(subproblems_.failure());
      const Verdict verdict = judge(problem_, *point, held_);
      const auto outcome = verdict.is_feasible ? leave_face(*point, verdict) : approach(*point, verdict);
      if (outcome) return *outcome;
    }
    return Status::iteration_limit;
  }

 private:
  // Step 3: takes the minimiser of the subproblem and releases unknowns.
  std::optional<Status> leave_face(const SubproblemPoint& point, const Verdict& verdict) {
    here_ = evaluate(problem_, project(problem_, point.z));
    solution_.z = point.z;
    solution_.multiplier = point.multiplier;
    const bool seen_before = !minimisers_.insert(fingerprint(problem_, held_)).second;
    const std::int64_t changes = record(point, verdict, point.energy, verdict.worst_multiplier, verdict.next);
    if (changes == 0) return Status::solved;
    if (seen_before) return Status::cycling;
    held_at_minimiser_ = held_;
    held_ = verdict.next;
    released_.clear();
    if (changes > 1) released_ = held_;
    return {};
  }

  // Step 2: moves towards the minimiser of the subproblem, as far as the energy decreases in the box.
  std::optional<Status> approach(const SubproblemPoint& point, const Verdict& verdict) {
    auto z = projected_line_search(problem_, here_, point.z);
    if (!z) return Status::cycling;
    here_ = evaluate(problem_, std::move(*z));
    solution_.z = here_.z;
    solution_.multiplier = here_.gradient;
    const ActiveSet next = everything_at_bounds(problem_, here_.z);
    record(point, verdict, here_.energy, 0, next);
    held_ = next;
    released_.clear();
    return {};
  }

  // Returns the number of changes.
  std::int64_t record(const SubproblemPoint& point, const Verdict& verdict, double energy, double worst_multiplier,
                      const ActiveSet& next) {
    solution_.activity = held_;
    solution_.linear_residual = point.linear_residual;
    solution_.tolerances = point.tolerances;
    solution_.iterations.push_back({.active = count_active(problem_, held_),
                                    .changes = count_changes(problem_, held_, next),
                                    .energy = energy,
                                    .worst_violation = verdict.worst_violation,
                                    .worst_multiplier = worst_multiplier,
                                    .linear_steps = point.linear_steps,
                                    .safeguarded = true});
    if (observer_.iteration) observer_.iteration(solution_.iterations.back());
    return solution_.iterations.back().changes;
  }

  const BoxProblem& problem_;
  SubproblemSolver& subproblems_;
  const Settings& settings_;
  const Observer& observer_;
  BoxSolution& solution_;
  Feasible here_;
  ActiveSet held_;               ///< fixed unknowns; they define the subproblem
  ActiveSet held_at_minimiser_;  ///< set before the last release
  ActiveSet released_;           ///< set after it; empty unless the release has just happened with several unknowns
  std::set<std::uint64_t> minimisers_;
};

}  // namespace

void continue_projected_search(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                               const Observer& observer, BoxSolution& so_far) {
  so_far.status = ProjectedSearch(problem, subproblems, settings, observer, so_far).run();
  if (so_far.status == Status::not_held && problem.shift == 0)
    continue_proximal_points(problem, subproblems, settings, observer, so_far);
}

BoxSolution solve_projected_search(const BoxProblem& problem, std::span<const Activity> initial,
                                   algebra::Preconditioner& preconditioner, const Settings& settings,
                                   const Observer& observer) {
  if (!problem.pressing.empty())
    return solve_by_pressing_search(problem, initial, preconditioner, settings, observer, solve_projected_search);
  if (problem.equations)
    return solve_by_dual_ascent(problem, initial, preconditioner, settings, observer, solve_projected_search);
  BoxSolution solution = unsolved(problem, Status::infeasible);
  if (!bounds_are_consistent(problem)) return solution;
  SubproblemSolver subproblems(problem, preconditioner, settings);
  auto point = subproblems.solve_first(initial);
  solution.status = subproblems.failure();
  if (!point) return solution;
  solution.z = std::move(point->z);
  continue_projected_search(problem, subproblems, settings, observer, solution);
  return solution;
}

}  // namespace plastron::contact
