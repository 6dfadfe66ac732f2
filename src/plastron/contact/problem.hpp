// The box-constrained quadratic program of contact in nodal coordinates, and its solution:
//   minimise 1/2 z' A z - b' z   subject to   lower <= z <= upper   and, if there are any, equations B z = 0.
// Given forces may move bounds (docs/methods/pressing-obstacles.md). Then their positions delta_k are unknowns, too:
//   minimise 1/2 z' A z - b' z - sum_k F_k delta_k   subject to   lower(delta) <= z <= upper(delta),   both affine in
//   delta.
// The file does not depend on shells: it has unknowns, bounds, multipliers.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace plastron::contact {

/// Computes y = A z for owned values (collective). The ghosts of z are current.
using Operator = std::function<void(const algebra::Vector& z, algebra::Vector& y)>;

/// Linear equations B z = 0 beside the bounds, each with a multiplier, as operators (all collective). Rows may be
/// empty; their multipliers stay zero.
struct EqualityConstraints {
  algebra::Vector multipliers;  ///< zero; defines their layout
  Operator apply;               ///< q = B z
  Operator apply_transposed;    ///< z = B' q
  Operator precondition;  ///< approximate multiple of (B A^{-1} B')^{-1}, symmetric and definite; zero on empty rows
};

/// A force F that moves bounds: lower_i(delta) = lower_i + sum_k delta_k lower_shape_ki, upper_i likewise. Shapes are
/// finite. They are zero on prescribed unknowns and on those that the force does not bound. The unit of its position
/// delta is the unit of z over the unit of the shapes.
struct PressingForce {
  algebra::Vector lower_shape, upper_shape;
  double force;  ///< F > 0, in the direction of larger delta
};

struct BoxProblem {
  const algebra::Matrix& matrix;  ///< A as assembled: factorised, used as preconditioner
  Operator apply;                 ///< A z as exactly as possible (through strains): defines residuals and multipliers
  algebra::Vector load;           ///< b
  algebra::Vector lower;          ///< -infinity where there is no bound
  algebra::Vector upper;          ///< +infinity where there is no bound; lower == upper prescribes the unknown
  std::optional<EqualityConstraints> equations{};
  double shift = 0;                ///< rho >= 0: A is `matrix` + rho diag(`matrix`), and `apply` includes the shift
  bool may_be_indefinite = false;  ///< A may have negative eigenvalues: a set without a minimiser ends the search
  std::vector<PressingForce> pressing{};  ///< if not empty, lower and upper are the bounds at delta = 0
};

/// State of an unknown. Prescribed unknowns keep it; at_lower and at_upper form the active set.
enum class Activity : char { free = 0, at_lower = 1, at_upper = 2, prescribed = 3 };

enum class Status {
  solved,
  iteration_limit,  ///< max_iterations reached
  cycling,          ///< the active set occurred again, and the safeguarded search could not continue
  /// Some lower > upper (or forces press them there), or equations that cannot be satisfied within the bounds.
  infeasible,
  singular,               ///< A is not positive definite even with every bound active: a motion is free
  not_held,               ///< a motion is free on the last active set, though more active bounds would fix it
  not_carried,            ///< a pressing force moves its bounds without limit
  linear_solver_stalled,  ///< the preconditioned iteration missed its tolerance by a large factor
  not_finite,             ///< numbers overflowed or are NaN
  interrupted,            ///< the caller requested a stop
  gap_not_met,     ///< solved, but the bounds were linearised at another point; set by the caller that linearises
  no_equilibrium,  ///< finite rotations: the Newton steps did not come to rest; set by the caller that makes them
  /// Solved, but a motion on the touching face lowers the energy; set by the caller that examines it.
  unstable,
  /// Solved, but a quantity that was recomputed independently misses its limit; set by the caller that recomputes.
  inaccurate,
  /// Solved, but the estimated errors are above the requested limit; set by the caller that estimates.
  accuracy_not_reached
};
/// Returns all of them.
std::span<const Status> statuses();
std::string_view to_string(Status status);
/// Returns one sentence for the user: what happened and what to do.
std::string_view explain(Status status);

struct Iteration {
  std::int64_t active = 0;      ///< unknowns at a bound (without prescribed ones)
  std::int64_t changes = 0;     ///< unknowns whose activity changed after this solve
  double energy = 0;            ///< 1/2 z' A z - b' z - sum_k F_k delta_k
  double worst_violation = 0;   ///< largest violation of a bound before projection
  double worst_multiplier = 0;  ///< most negative multiplier (0 if none)
  int linear_steps = 0;         ///< conjugate-gradient steps
  bool safeguarded = false;     ///< true if the safeguarded search made it
};

/// Callbacks that follow the iterations; both may be empty.
struct Observer {
  std::function<void(const Iteration&)> iteration{};  ///< called after every iteration
  std::function<bool()> stop{};  ///< called before every further iteration; must return the same on all ranks

  bool wants_to_stop() const { return stop && stop(); }
};

/// Limits below which a bound or a sign counts as satisfied: the requested limit, or the rounding if that is larger.
struct Tolerances {
  double gap = 0;         ///< limit of a bound, relative to the largest unknown that has a bound
  double multiplier = 0;  ///< limit of a multiplier, relative to the largest one at a bound
};

struct BoxSolution {
  Status status = Status::iteration_limit;
  algebra::Vector z{};
  /// A z - b, with equations A z + B' q - b: >= 0 at a lower bound, <= 0 at an upper one, 0 where free.
  algebra::Vector multiplier{};
  algebra::Vector equation_multiplier{};  ///< q, with ghosts; empty without equations
  std::vector<Activity> activity{};       ///< activities of the owned unknowns
  std::vector<double> positions{};        ///< delta_k of the pressing forces, the same on all ranks
  std::vector<Iteration> iterations{};
  double linear_residual = 0;  ///< relative residual of the last linear solve
  Tolerances tolerances{};     ///< tolerances of the last iteration
};

}  // namespace plastron::contact
