// One Newton step of a shell with finite rotations in contact: a box problem in increments of (u, r), solved to its end.
#pragma once
#include <plastron/contact/settings.hpp>
#include <plastron/finite/tangent.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace plastron::finite {

/// Data with which a step starts, beside the shell linearised at its state.
struct StepStart {
  Prestress prestress{};
  algebra::Vector zone{};    ///< a value for each node and obstacle, above one half where contact is likely
  double shift = 0;          ///< the first shift that is tried
  double next_shift = 1e-6;  ///< the shift that is tried if the first does not suffice
};

/// Result of a step.
struct NewtonStep {
  contact::BoxSolution box{};  ///< the increment in the coordinates of the shell, and its status
  int factorisations = 0;
  /// Part of its diagonal that was added to the tangent stiffness, because a motion has no positive stiffness; else 0.
  double shift = 0;
  double largest_rotation = 0;      ///< largest |s| of the increment [rad]
  double largest_displacement = 0;  ///< largest |v| of the increment [m]
  std::optional<double> part{};     ///< taken where a bed leaves its segments: assembly::part_by_beds()
  double load_change = 0;           ///< change of the load factor under control
  bool is_control_blind = false;    ///< the loads do not move the displacement that is to control them
  algebra::Vector increment{};      ///< (v, s), block 6
  StepStart next{};                 ///< start of the step from the end of this one
  /// Rotations above this limit are shortened, because longer steps can diverge [rad].
  static constexpr double longest_rotation = 0.5;
  bool is_too_long() const { return largest_rotation > longest_rotation; }
  contact::Status status() const { return box.status; }
};

/// Returns the same shell with finite rotations, at the state that a linear solution suggests: its displacements with
/// directors of their lengths in the reference (collective). Throws SupportError, ObstacleError.
std::unique_ptr<assembly::DiscreteShell> with_finite_rotations(const assembly::DiscreteShell& discrete,
                                                               const solution::NodalSolution& solution);

/// Whether the solver met a set of active bounds on which the energy has no minimum.
bool has_no_minimiser(contact::Status status);

/// Makes the step: gaps (M28), equilibrium (M29) and stiffness (M30) are linearised at the state of the shell. Where the
/// tangent stiffness is not definite, shifts are tried until the problem has a solution; a shifted step is shorter
/// (collective). Precondition: finite rotations.
NewtonStep newton_step(const assembly::DiscreteShell& discrete, const StepStart& start,
                       const contact::Settings& settings, const contact::Observer& observer = {});

/// Totals of the linearised shell after a step.
struct StepTotals {
  double energy = 0;                               ///< (M27) of the linearised strains [J]
  std::vector<Eigen::Vector3d> obstacle_forces{};  ///< forces on the shell [N]
  double contact_area = 0;                         ///< sum of the nodal areas in contact [m^2]
};
/// Computes the totals, before the shell is linearised at the next state (collective).
StepTotals totals_after(const assembly::DiscreteShell& discrete, const NewtonStep& step);

/// Returns the contact problem at a solution with the derivative of its equations, as dual problems need it: increments are 0, bounds act
/// where nodes touch, multipliers are the reactions. Where coordinates are those of (u, r), it is the problem of which `solved` is the
/// solution (collective). `matrix`: derivative_at() the solution; it must outlive the result.
struct ProblemAtSolution {
  contact::BoxProblem box;
  contact::BoxSolution z;
};
ProblemAtSolution problem_at(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
                             const contact::BoxSolution& solved, const algebra::Matrix& matrix);

/// Returns the potential of dead loads and of the shell at its state, with `weight` [N] times the depth of nodes in obstacles: with
/// a weight above all reactions its minima are those of the contact problem (collective) [J].
double potential(const assembly::DiscreteShell& discrete, double weight);
/// Returns the largest force of an obstacle on a node after a step (collective) [N].
double largest_reaction(const assembly::DiscreteShell& discrete, const NewtonStep& step);

/// Returns the state after a step, which is shortened if it is too long. `next.prestress` is shortened alike (collective).
assembly::State next_state(const assembly::DiscreteShell& discrete, const StepStart& start, NewtonStep& step);

}  // namespace plastron::finite
