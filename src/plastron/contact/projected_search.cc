// The projected search: the safeguard of the primal-dual method, with a proof that it ends; also a solver of its own.
// It keeps a feasible z and lowers the energy E at each step:
//   1. Fix the unknowns at bounds; let z* minimise E on this subproblem.
//   2. If z* is outside the box, search along the projection P(z + t (z* - z)), t = 1, 1/2, ..., for the lowest energy
//      that is less than E(z) by a fraction of the slope. Fix also the unknowns that have reached a bound, and go to 1.
//   3. If z* is feasible, take it. If no multiplier has the wrong sign, it is the solution. Otherwise release all fixed
//      unknowns with wrong signs and go to 1 with this larger subproblem.
// Proof that it ends: steps 1-2 only add fixed unknowns, so after finitely many steps z* is feasible and 3 is reached.
// Then z is the minimiser of a subproblem. After 3 the direction z* - z lowers the energy to first order. This is true
// even where a released unknown at its bound is pushed outwards and stays, because its slope first has the right sign.
// Hence a small enough t gives a strict decrease. Energies of subproblem minimisers therefore decrease strictly, and no
// subproblem occurs twice. Their number is finite. If a subproblem minimiser occurs again nevertheless, the energies
// differ by rounding only: status cycling. Sources: Bertsekas, Projected Newton methods for optimization problems with
// simple constraints (1982): the projected step and its descent; More and Toraldo, On the solution of large quadratic
// programming problems with bound constraints (1991): finishing a subproblem before leaving it.
#include <plastron/contact/searches.hpp>

#include <algorithm>
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
ActiveSet release_one(const BoxProblem& problem, const ActiveSet& set, const ActiveSet& released,
                      const Vector& multiplier, const Vector& diagonal) {
  const MPI_Comm comm = problem.load.layout()->comm;
  const auto first = static_cast<double>(problem.load.layout()->first) * problem.load.block();
  double most = -1;
  double chosen = std::numeric_limits<double>::infinity();
  const auto promise = [&](std::size_t i) {
    const double m = multiplier.owned()[i];
    return set[i] == released[i] ? -1.0 : m * m / diagonal.owned()[i];
  };
  for (std::size_t i = 0; i < set.size(); ++i) most = std::max(most, promise(i));
  most = algebra::max_over_ranks(most, comm);
  for (std::size_t i = set.size(); i-- > 0;)
    if (promise(i) >= most) chosen = first + static_cast<double>(i);
  chosen = algebra::min_over_ranks(chosen, comm);
  ActiveSet one = set;
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
    set_ = everything_at_bounds(problem_, here_.z);
  }

  Status run() {
    while (static_cast<int>(solution_.iterations.size()) < settings_.max_iterations) {
      if (observer_.wants_to_stop()) return Status::interrupted;
      const auto point = subproblems_.solve(set_);
      if (!point && !released_.empty()) {
        set_ = release_one(problem_, minimiser_set_, released_, solution_.multiplier, subproblems_.diagonal());
        released_.clear();
        continue;
      }
      if (!point) return after_a_first_step(subproblems_.failure());
      const Verdict verdict = judge(problem_, *point, set_);
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
    const bool seen_before = !minimisers_.insert(fingerprint(problem_, set_)).second;
    const std::int64_t changes = record(point, verdict, point.energy, verdict.worst_multiplier, verdict.next);
    if (changes == 0) return Status::solved;
    if (seen_before) return Status::cycling;
    minimiser_set_ = set_;
    set_ = verdict.next;
    released_.clear();
    if (changes > 1) released_ = set_;
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
    set_ = next;
    released_.clear();
    return {};
  }

  // Returns the number of changes.
  std::int64_t record(const SubproblemPoint& point, const Verdict& verdict, double energy, double worst_multiplier,
                      const ActiveSet& next) {
    solution_.activity = set_;
    solution_.linear_residual = point.linear_residual;
    solution_.tolerances = point.tolerances;
    solution_.iterations.push_back({.active = count_active(problem_, set_),
                                    .changes = count_changes(problem_, set_, next),
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
  ActiveSet set_;            ///< fixed unknowns; they define the subproblem
  ActiveSet minimiser_set_;  ///< set before the last release
  ActiveSet released_;       ///< set after it; empty unless the release has just happened with several unknowns
  std::set<std::uint64_t> minimisers_;
};

}  // namespace

void continue_projected_search(const BoxProblem& problem, SubproblemSolver& subproblems, const Settings& settings,
                               const Observer& observer, BoxSolution& so_far) {
  so_far.status = ProjectedSearch(problem, subproblems, settings, observer, so_far).run();
}

}  // namespace plastron::contact
