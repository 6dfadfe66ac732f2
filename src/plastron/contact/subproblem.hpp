// The equality-constrained subproblem: active and prescribed unknowns are fixed at their bounds (a face of the box),
// all others are free. Contact solvers differ in the choice of the next subproblem. An available factor serves further
// sets where that is cheaper than a new one.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/contact/subproblem_point.hpp>

#include <optional>

namespace plastron::contact {

class SubproblemSolver {
 public:
  SubproblemSolver(const BoxProblem& problem, algebra::Preconditioner& preconditioner, const Settings& settings);

  /// Returns nothing if the subproblem has no unique minimiser or the computation fails; failure() then gives the
  /// reason. (collective)
  std::optional<SubproblemPoint> solve(const ActiveSet& set);
  /// Solves with a factor of exactly this set, which remains available for refine() and response(). (collective)
  std::optional<SubproblemPoint> solve_anew(const ActiveSet& set);
  /// Returns the point of the set that solve_anew() factorised, from a near z, after the bounds have moved.
  /// (collective)
  std::optional<SubproblemPoint> refine(const ActiveSet& set, algebra::Vector z);
  /// Computes z with (A z)_i = 0 where `set` is free and z_i = values_i where `set` is fixed; with equations A z + B'
  /// q = 0, B z = 0. The residual is - A z (- A z - B' q). Nothing if the computation fails. Call it after
  /// solve_anew(). (collective)
  std::optional<algebra::CgResult> response(const ActiveSet& set, const algebra::Vector& values, algebra::Vector& z);
  /// Returns the first point of a solver: on `initial` or, where that leaves a motion free, with every bound active.
  /// (collective)
  std::optional<SubproblemPoint> solve_first(std::span<const Activity> initial);
  Status failure() const { return failure_; }

  /// Sets a first guess of the equations' multipliers for the next solve().
  void start_multipliers_from(const algebra::Vector& q) { q_ = q; }

  /// Returns the part of a violation B z that remains for every q, nearly its part in the kernel of B' on the free
  /// unknowns. Call it directly after solve() found that the equations cannot be satisfied on this set. (collective)
  algebra::Vector irreducible(const ActiveSet& set, const algebra::Vector& violation) const;

  const algebra::Vector& diagonal() const { return diagonal_; }
  algebra::Preconditioner& preconditioner() { return preconditioner_; }

 private:
  bool fix(const ActiveSet& set);
  void follow(const ActiveSet& set);
  std::optional<SubproblemPoint> solve_with_kept_factor(const ActiveSet& set);
  void put_at_bounds(const ActiveSet& set, algebra::Vector& z) const;
  algebra::CgResult solve_linear(const ActiveSet& set, const algebra::Vector& load, const algebra::CgSettings& settings,
                                 algebra::Vector& z) const;
  algebra::CgResult solve_system(const ActiveSet& set, const algebra::Vector& load, algebra::Vector& q,
                                 algebra::Vector& z) const;
  algebra::CgResult solve_with_equations(const ActiveSet& set, const algebra::Vector& right, algebra::Vector& q,
                                         algebra::Vector& z) const;
  bool is_usable(const algebra::CgResult& linear);
  SubproblemPoint complete(algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set);
  algebra::CgResult multiplier_step(const ActiveSet& set, const algebra::Vector& violation,
                                    algebra::Vector& step) const;

  const BoxProblem& problem_;
  algebra::Preconditioner& preconditioner_;
  const Settings& settings_;
  algebra::Vector diagonal_;
  std::optional<ActiveSet> fixed_{};  ///< the set that the preconditioner fixes
  algebra::Vector q_{};               ///< multipliers of the equations, kept from subproblem to subproblem
  algebra::Vector nearby_{};          ///< minimiser of the previous subproblem
  Status failure_ = Status::singular;
};

/// Returns the status of a failure after some subproblem had a minimiser: the active set then fixed a motion that is
/// free now.
constexpr Status after_a_first_step(Status failure) { return failure == Status::singular ? Status::not_held : failure; }

/// Returns the number of conjugate-gradient steps that cost less than a preconditioner of another set. A step is an
/// application of the preconditioner and two products through strains. It counts operations, so that decisions are the
/// same in every run (benchmarks/step_cost; docs/performance.md).
int affordable_steps(const algebra::Price& price, double unknowns);
/// Returns the number of steps to try with the available factor after `changes` changed unknowns; 0: factorise anew.
int steps_to_try(KeptFactor rule, const algebra::Price& price, double unknowns, std::int64_t changes);

}  // namespace plastron::contact
