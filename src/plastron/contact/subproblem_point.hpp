// A point found on a subproblem, and its properties: multipliers, their rounding, violations of the optimality
// conditions. All contact solvers use these criteria, so that they end alike.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

namespace plastron::contact {

struct SubproblemPoint {
  algebra::Vector z{};
  algebra::Vector multiplier{};           ///< A z - b, with equations A z + B' q - b
  algebra::Vector equation_multiplier{};  ///< q; empty without equations
  std::vector<double> positions{};        ///< positions of the pressing forces
  std::vector<Touch> touched{};           ///< unknowns that carry a pressing force from now on and will become active
  algebra::Vector multiplier_noise{};     ///< lower estimate of the rounding of each multiplier
  double energy = 0;
  algebra::Vector gap_noise{};  ///< violations up to this value are ignored
  Tolerances tolerances{};
  bool has_converged = true;  ///< whether the linear solve reached its tolerance or rounding
  double linear_residual = 0;
  int linear_steps = 0;
};

/// Assesses z, which the caller found on `set`. `linear` is the outcome of its linear solve with the residual b - A z
/// (b - A z - B' q), `diagonal` A's. The multiplier of equations stays empty. (collective)
SubproblemPoint assess(const BoxProblem& problem, const Settings& settings, const algebra::Vector& diagonal,
                       algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set);

/// Violations of the optimality conditions at the point, and the active set that corrects all of them at once.
struct Verdict {
  ActiveSet next{};
  bool is_feasible = true;      ///< no free unknown is beyond a bound by more than noise
  double worst_violation = 0;   ///< largest violation of a bound by a free unknown
  double worst_multiplier = 0;  ///< most negative, with opposite sign at upper bounds; 0 if none is negative
};
/// Judges a point. Free unknowns beyond a bound and touched unknowns become active. Active ones with multipliers of the
/// wrong sign become free. `problem` has its bounds at the point's positions. (collective)
Verdict judge(const BoxProblem& problem, const SubproblemPoint& point, const ActiveSet& set);

/// Returns a solution of the right size for the start of a solver: zeros, nothing active, and the status.
BoxSolution unsolved(const BoxProblem& problem, Status status);
/// Stores the point as the solution so far and as an iteration, and calls the observer. Returns the number of unknowns
/// whose activity changes. (collective)
std::int64_t record(const BoxProblem& problem, SubproblemPoint point, const ActiveSet& set, const Verdict& verdict,
                    const Observer& observer, BoxSolution& solution);

}  // namespace plastron::contact
