// The box-constrained quadratic program that contact becomes in nodal coordinates, and its solution:
//   minimise 1/2 z' A z - b' z   subject to   lower <= z <= upper   and, if there are any, equations B z = 0.
// Given forces may move bounds along (docs/methods/pressing-obstacles.md): then their positions delta_k are unknowns, too,
//   minimise 1/2 z' A z - b' z - sum_k F_k delta_k   subject to   lower(delta) <= z <= upper(delta),   both affine in delta.
// Nothing here knows of shells: unknowns, bounds, multipliers.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/algebra/vector.hpp>

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace plastron::contact {

/// y = A z for owned values (collective); z comes with ghosts up to date.
using Operator = std::function<void(const algebra::Vector& z, algebra::Vector& y)>;

/// Linear equations B z = 0 beside the bounds, each with a multiplier, in operator form (all collective). Rows may be empty;
/// their multipliers stay zero.
struct EqualityConstraints {
  algebra::Vector multipliers;  ///< zero; gives their layout
  Operator apply;               ///< q = B z
  Operator apply_transposed;    ///< z = B' q
  Operator precondition;  ///< roughly a multiple of (B A^{-1} B')^{-1}, symmetric and definite; zero on empty rows
};

/// A force F that moves bounds along: lower_i(delta) = lower_i + sum_k delta_k lower_shape_ki, upper_i alike. Shapes are finite, zero on
/// unknowns that it does not bound and on prescribed ones. Its position delta has the unit of z over that of the shapes.
struct PressingForce {
  algebra::Vector lower_shape, upper_shape;
  double force;  ///< F > 0: towards larger delta
};

struct BoxProblem {
  const algebra::Matrix& matrix;  ///< A as assembled: factorised, used as preconditioner
  Operator apply;                 ///< A z as exactly as can be had (through strains): defines residuals and multipliers
  algebra::Vector load;           ///< b
  algebra::Vector lower;          ///< -infinity where there is no bound
  algebra::Vector upper;          ///< +infinity where there is none; lower == upper prescribes the unknown
  std::optional<EqualityConstraints> equations{};
  double shift = 0;                       ///< rho >= 0: A is `matrix` + rho diag(`matrix`), and `apply` has it
  std::vector<PressingForce> pressing{};  ///< with these, lower and upper are the bounds at delta = 0
};

/// Where an unknown stands. Prescribed unknowns never leave; at_lower and at_upper make the active set.
enum class Activity : char { free = 0, at_lower = 1, at_upper = 2, prescribed = 3 };

enum class Status {
  solved,
  iteration_limit,  ///< max_iterations reached
  cycling,          ///< the active set came back and the safeguarded search could not go on either
  infeasible,   ///< some lower > upper (or forces press them there), or equations that cannot hold within the bounds
  singular,     ///< A is not positive definite even with every bound active: a motion is left free
  not_held,     ///< a motion is free on the active set that came up, though more active bounds would hold it
  not_carried,  ///< a pressing force moves its bounds on for ever
  linear_solver_stalled,  ///< the preconditioned iteration missed its tolerance by far
  not_finite,             ///< numbers overflowed or are no numbers
  interrupted,            ///< somebody asked to stop
  gap_not_met,            ///< solved, but what the bounds were linearised at is another point; set by who linearises
  inaccurate,             ///< solved, but what was recomputed independently misses its limit; set by who recomputes
  accuracy_not_reached    ///< solved, but the estimated errors are above what was asked for; set by who estimates
};
std::string_view to_string(Status status);
/// One sentence for the user: what happened and what to do.
std::string_view explain(Status status);

struct Iteration {
  std::int64_t active = 0;      ///< unknowns at a bound (prescribed ones not counted)
  std::int64_t changes = 0;     ///< unknowns that changed sides after this solve
  double energy = 0;            ///< 1/2 z' A z - b' z - sum_k F_k delta_k
  double worst_violation = 0;   ///< largest violation of a bound before projection
  double worst_multiplier = 0;  ///< most negative multiplier (0 if none)
  int linear_steps = 0;         ///< conjugate-gradient steps
  bool safeguarded = false;     ///< made by the safeguarded search
};

/// Follows the iterations; both may be empty.
struct Observer {
  std::function<void(const Iteration&)> iteration{};  ///< called after every one
  std::function<bool()> stop{};                       ///< asked before every next one; must answer alike on all ranks

  bool wants_to_stop() const { return stop && stop(); }
};

/// Below which a bound or a sign counts as kept: what was asked for, or what rounding left of it where that is more.
struct Tolerances {
  double gap = 0;         ///< of a bound, over the largest unknown that has one
  double multiplier = 0;  ///< of a multiplier, over the largest one at a bound
};

struct BoxSolution {
  Status status = Status::iteration_limit;
  algebra::Vector z{};
  /// A z - b, with equations A z + B' q - b: >= 0 at a lower bound, <= 0 at an upper one, 0 where free.
  algebra::Vector multiplier{};
  algebra::Vector equation_multiplier{};  ///< q, with ghosts; empty without equations
  std::vector<Activity> activity{};       ///< of the owned unknowns
  std::vector<double> positions{};        ///< delta_k of the pressing forces, the same on all ranks
  std::vector<Iteration> iterations{};
  double linear_residual = 0;  ///< reached by the last linear solve, relative
  Tolerances tolerances{};     ///< of the last iteration
};

}  // namespace plastron::contact
