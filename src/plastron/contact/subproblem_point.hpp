// A point found on a subproblem, and what is to be said of it: multipliers, what rounding made of them, how it breaks the optimality
// conditions. All contact solvers judge by this, so that they end alike.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

namespace plastron::contact {

/// An unknown that stands at a bound, though its set calls it free.
struct Touch {
  std::size_t unknown;
  Activity activity;
};

struct SubproblemPoint {
  algebra::Vector z{};
  algebra::Vector multiplier{};           ///< A z - b, with equations A z + B' q - b
  algebra::Vector equation_multiplier{};  ///< q; empty without equations
  std::vector<double> positions{};        ///< of the pressing forces
  std::vector<Touch> touched{};           ///< what carries a pressing force from here on; to become active
  algebra::Vector multiplier_noise{};     ///< what rounding makes of each multiplier, at least
  double energy = 0;
  algebra::Vector gap_noise{};  ///< violations up to here are no violations
  Tolerances tolerances{};
  bool has_converged = true;  ///< the linear solve: to its tolerance or to what rounding permits
  double linear_residual = 0;
  int linear_steps = 0;
};

/// Of z, which somebody found on `set`. `linear` is the outcome of its linear solve with the residual b - A z (b - A z - B' q),
/// `diagonal` A's. The multiplier of equations is left empty. (collective)
SubproblemPoint assess(const BoxProblem& problem, const Settings& settings, const algebra::Vector& diagonal,
                       algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set);

/// How the point breaks the optimality conditions, and the active set that puts all of it right at once.
struct Verdict {
  ActiveSet next{};
  bool is_feasible = true;      ///< no free unknown is beyond a bound by more than noise
  double worst_violation = 0;   ///< of a bound by a free unknown
  double worst_multiplier = 0;  ///< most negative, the sign turned at upper bounds; 0 if none is negative
};
/// Free unknowns beyond a bound become active, and so do those that were touched; active ones with multipliers of the wrong sign become
/// free. `problem` has its bounds where the point's positions put them. (collective)
Verdict judge(const BoxProblem& problem, const SubproblemPoint& point, const ActiveSet& set);

/// The point becomes the solution so far and an iteration of it, which the observer is told. Returns the number of unknowns that
/// change sides. (collective)
std::int64_t record(const BoxProblem& problem, SubproblemPoint point, const ActiveSet& set, const Verdict& verdict,
                    const Observer& observer, BoxSolution& solution);

}  // namespace plastron::contact
