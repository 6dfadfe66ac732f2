// The equality-constrained subproblem: active and prescribed unknowns are held at their bounds (a face of the box), all others
// are free. Every contact solver is a way of choosing the next one.
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

  /// Nothing if the subproblem has no unique minimiser or it cannot be computed; failure() then tells which. (collective)
  std::optional<SubproblemPoint> solve(const ActiveSet& set);
  /// The same with a factor of this very set, which stays at hand for refine() and response(). (collective)
  std::optional<SubproblemPoint> solve_anew(const ActiveSet& set);
  /// The point of the set that solve_anew() factorised, from a z nearby: after the bounds have moved. (collective)
  std::optional<SubproblemPoint> refine(const ActiveSet& set, algebra::Vector z);
  /// z with (A z)_i = 0 where `set` is free and z_i = values_i where it holds; with equations A z + B' q = 0, B z = 0. The residual is
  /// - A z (- A z - B' q). Nothing if it cannot be computed. After solve_anew(). (collective)
  std::optional<algebra::CgResult> response(const ActiveSet& set, const algebra::Vector& values, algebra::Vector& z);
  /// The point on `initial` or, where that leaves a motion free, with every bound active: where solvers begin. (collective)
  std::optional<SubproblemPoint> solve_first(std::span<const Activity> initial);
  Status failure() const { return failure_; }

  /// s with (A s - r)_i = 0 where `set` is free and s_i = 0 elsewhere; r is zero there. False if there is none, as with solve();
  /// equations are left out. (collective)
  bool solve_increment(const ActiveSet& set, const algebra::Vector& r, algebra::Vector& s);

  /// A first guess of the multipliers of the equations, for the next solve().
  void start_multipliers_from(const algebra::Vector& q) { q_ = q; }

  /// For a set on which solve() found that the equations cannot hold: what remains of a violation B z however q is chosen, about
  /// its part in the kernel of B' on the free unknowns. To be asked right after. (collective)
  algebra::Vector irreducible(const ActiveSet& set, const algebra::Vector& violation) const;

  const algebra::Vector& diagonal() const { return diagonal_; }
  algebra::Preconditioner& preconditioner() { return preconditioner_; }

 private:
  bool pin(const ActiveSet& set);
  void follow(const ActiveSet& set);
  std::optional<SubproblemPoint> solve_with_kept_factor(const ActiveSet& set);
  void hold(const ActiveSet& set, algebra::Vector& z) const;
  algebra::CgResult solve_linear(const ActiveSet& set, const algebra::Vector& load, const algebra::CgSettings& settings,
                                 algebra::Vector& z) const;
  algebra::CgResult solve_pinned(const ActiveSet& set, const algebra::Vector& load, algebra::Vector& q,
                                 algebra::Vector& z) const;
  algebra::CgResult solve_with_equations(const ActiveSet& set, const algebra::Vector& right, algebra::Vector& q,
                                         algebra::Vector& z) const;
  bool is_usable(const algebra::CgResult& linear);
  void solve_roughly(std::span<const char> fixed, const algebra::Vector& force, algebra::Vector& z) const;
  SubproblemPoint complete(algebra::Vector z, const algebra::CgResult& linear, const ActiveSet& set);
  algebra::CgResult multiplier_step(const ActiveSet& set, const algebra::Vector& violation,
                                    algebra::Vector& step) const;

  const BoxProblem& problem_;
  algebra::Preconditioner& preconditioner_;
  const Settings& settings_;
  algebra::Vector diagonal_;
  std::optional<ActiveSet> pinned_{};  ///< the subproblem that the preconditioner is ready for
  algebra::Vector q_{};                ///< multipliers of the equations, carried from subproblem to subproblem
  algebra::Vector nearby_{};           ///< minimiser of the subproblem before
  Status failure_ = Status::singular;
};

/// Marks of the unknowns that a set holds.
std::vector<char> held(const ActiveSet& set);
/// What it means for a subproblem that the preconditioner could not be pinned.
Status failure_of(algebra::Pinning pinning);
/// What a failure means once some subproblem had a minimiser: a motion that is free now was held then.
constexpr Status after_a_first_step(Status failure) { return failure == Status::singular ? Status::not_held : failure; }

}  // namespace plastron::contact
