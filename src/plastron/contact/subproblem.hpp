// The equality-constrained subproblem: active and prescribed unknowns are held at their bounds (a face of the box), all others
// are free. Every contact solver is a way of choosing the next one.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>

#include <optional>

namespace plastron::contact {

struct SubproblemPoint {
  algebra::Vector z{};
  algebra::Vector multiplier{};           ///< A z - b, with equations A z + B' q - b
  algebra::Vector equation_multiplier{};  ///< q; empty without equations
  algebra::Vector multiplier_noise{};     ///< what rounding makes of each multiplier, at least
  double energy = 0;
  algebra::Vector gap_noise{};  ///< violations up to here are no violations
  Tolerances tolerances{};
  bool has_converged = true;  ///< the linear solve: to its tolerance or to what rounding permits
  double linear_residual = 0;
  int linear_steps = 0;
};

class SubproblemSolver {
 public:
  SubproblemSolver(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings);

  /// Nothing if the subproblem has no unique minimiser or it cannot be computed; failure() then tells which. (collective)
  std::optional<SubproblemPoint> solve(const ActiveSet& set);
  Status failure() const { return failure_; }

  const algebra::Vector& diagonal() const { return diagonal_; }

 private:
  bool pin(const ActiveSet& set);
  std::optional<SubproblemPoint> solve_with_kept_factor(const ActiveSet& set);
  algebra::CgResult solve_linear(const ActiveSet& set, const algebra::Vector& load, const algebra::CgSettings& settings,
                                 algebra::Vector& z) const;
  algebra::CgResult solve_with_equations(const ActiveSet& set, algebra::Vector& z);
  void solve_roughly(std::span<const char> fixed, const algebra::Vector& force, algebra::Vector& z) const;
  bool multiplier_step(const ActiveSet& set, const algebra::Vector& violation, algebra::Vector& step) const;
  SubproblemPoint complete(algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set);
  bool is_bounded(std::size_t i) const;
  void measure_gap_noise(SubproblemPoint& point) const;
  void measure_multiplier_noise(SubproblemPoint& point, const ActiveSet& set) const;

  const BoxProblem& problem_;
  algebra::Preconditioner& preconditioner_;
  const Settings& settings_;
  algebra::Vector diagonal_;
  std::optional<ActiveSet> pinned_{};  ///< the subproblem that the preconditioner is ready for
  algebra::Vector q_{};                ///< multipliers of the equations, carried from subproblem to subproblem
  algebra::Vector nearby_{};           ///< minimiser of the subproblem before
  Status failure_ = Status::singular;
};

/// What a failure means once some subproblem had a minimiser: a motion that is free now was held then.
constexpr Status after_a_first_step(Status failure) { return failure == Status::singular ? Status::not_held : failure; }

/// How the point breaks the optimality conditions, and the active set that puts all of it right at once.
struct Verdict {
  ActiveSet next{};
  bool is_feasible = true;      ///< no free unknown is beyond a bound by more than noise
  double worst_violation = 0;   ///< of a bound by a free unknown
  double worst_multiplier = 0;  ///< most negative, the sign turned at upper bounds; 0 if none is negative
};
/// Free unknowns beyond a bound become active, active ones with multipliers of the wrong sign free. (collective)
Verdict judge(const BoxProblem& problem, const SubproblemPoint& point, const ActiveSet& set);

}  // namespace plastron::contact
