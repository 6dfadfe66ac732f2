// One Newton step of the shell with finite rotations in contact: a box problem in increments of (u, r), solved to its end.
#pragma once
#include <plastron/contact/settings.hpp>
#include <plastron/finite/tangent.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::finite {

/// Result of a step from a state.
struct NewtonStep {
  contact::Status status = contact::Status::solved;
  int factorisations = 0;
  /// Part of its diagonal that was added to the tangent stiffness, because a motion has no positive stiffness; else 0.
  double shift = 0;
  double largest_rotation = 0;                     ///< largest |s| of the increment [rad]
  double largest_displacement = 0;                 ///< largest |v| of the increment [m]
  State end{};                                     ///< state after the increment: directors not yet of length 1
  double energy = 0;                               ///< W (M27) of the linearised strains [J]
  std::vector<Eigen::Vector3d> obstacle_forces{};  ///< forces on the shell [N]
  double contact_area = 0;                         ///< sum of the nodal areas in contact [m^2]

  /// Rotations above this limit are shortened, because longer steps can diverge [rad].
  static constexpr double longest_rotation = 0.5;
  bool is_too_long() const { return largest_rotation > longest_rotation; }
};

/// Returns the stresses of a linear solution and the couples of its contact forces, on the undeformed shell (collective).
State prestress_of_linear(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Returns the state that a linear solution suggests for the first step with mixed integration points: its
/// displacements with directors of length 1, its stresses, its contact forces (collective).
State state_of_linear(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Makes the step: gaps (M28), equilibrium (M29) and stiffness (M30) are linearised at the state. Where the tangent stiffness is
/// not definite, shifts are tried until the problem has a solution; a shifted step is shorter (collective). Throws
/// SupportError, ObstacleError.
NewtonStep newton_step(const assembly::DiscreteShell& discrete, const State& state, const contact::Settings& settings,
                       const contact::Observer& observer = {});

/// Returns the state after a step, which is shortened if it is too long.
State next_state(const assembly::DiscreteShell& discrete, const State& state, const NewtonStep& step);

}  // namespace plastron::finite
