// Small motions about a solution, with the nodes in contact held on their obstacles: n . (v + z s) = 0 there. Buckling loads,
// natural frequencies, and whether an equilibrium with finite rotations is stable. K_M is the stiffness of the material at the
// state, K_G the geometric stiffness of the solution's stresses and contact forces (tangent.hpp), M the mass.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace plastron::finite {

struct Modes {
  bool has_solution = false;  ///< false if the stiffness is not definite, or if the iteration did not converge
  bool was_stopped = false;
  std::vector<double> values{};
  std::vector<algebra::Vector> shapes{};  ///< (u, r), block 6, with current ghosts; the largest |u| is 1
};

/// Returns the smallest positive factors of all loads and prescribed displacements (of stresses and contact forces, where the
/// shell is deformed by finite rotations) at which the shell buckles,
/// (K_M + factor K_G) v = 0, ascending: at most `count`. Without a solution if a motion is free. `stop` is asked on the
/// way, and gives the same on all ranks (collective).
Modes buckling_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count,
                     const std::function<bool()>& stop = {});

/// Returns the smallest squares of angular frequencies [1/s^2], (K_M + K_G) v = omega^2 M v, ascending. Free motions have
/// 0; negative ones grow: the solution is not stable. Precondition: some density (collective).
Modes vibration_modes(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution, int count,
                      const std::function<bool()>& stop = {});

/// Second-order conditions of an equilibrium with finite rotations.
struct Stability {
  /// Smallest theta of (K_M + K_G) v = theta K_M v, with the curvature of obstacles: 1 without stresses, 0 at a critical state,
  /// negative where a motion lowers the energy; NaN if K_M is not definite, so that a motion costs nothing.
  double margin = std::numeric_limits<double>::quiet_NaN();
  /// The same if nodes may leave their obstacle whose eta is below weak_part of its largest. Where such nodes alone keep a
  /// shell in place, a small disturbance can make it snap. Equal to the margin without such nodes.
  double margin_without_weak_contact = std::numeric_limits<double>::quiet_NaN();
  std::int64_t weak_nodes = 0;  ///< number of these nodes
  /// Under control, the margin where the loads stay as they are and the controlled point may move; negative beyond limit points
  /// of the loads.
  std::optional<double> margin_under_loads{};

  static constexpr double weak_part = 1e-2;
};

struct ExaminedStability {
  Stability stability{};
  /// (u, r) of the motion of the margin, the largest |u| is 1; without layout where the margin is 1 or NaN.
  algebra::Vector motion{};
  /// The same for the margin without weak contact, away from the obstacles, if that contact is idle and the margin not positive.
  algebra::Vector away{};
};

/// Whether contact is idle: weak nodes have more than half of its area and less than 0.01 of its force. Where a strip lies flat on a wall,
/// an imperfection makes it touch, and another one would not (collective).
bool has_idle_contact(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Examines a solution at the state of its shell (collective). Throws ObstacleError.
ExaminedStability examine_stability(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

}  // namespace plastron::finite
