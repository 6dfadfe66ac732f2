// The outer loop over linearised gaps (M16): solve, then linearise at the displaced faces, until the linearised gap
// equals the distance of the deformed faces from the obstacles. Planes do not need it because their gap is linear. If
// an obstacle is left out at a node because others are nearer, it is included when the shell has come closer to it. So is the
// exact gap of an obstacle on the other side of the shell.
#pragma once
#include <plastron/problem/problem.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <optional>

namespace plastron::computation {

/// Difference between the linearised gaps and the distances of the deformed faces (collective).
struct GapError {
  double at_contact = 0;  ///< largest |distance - gap| of the faces that touch [m]
  double depth = 0;       ///< largest depth of a face at a node inside an obstacle [m]
};
GapError gap_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Whether another linearisation can be needed: there are curved obstacles, or rows without an exact bound that may
/// become relevant (collective).
bool has_rows_to_meet(const assembly::DiscreteShell& discrete);

/// Distance of a solution from the state at which its gaps were linearised.
struct Nearness {
  double distance = 0;    ///< largest distance of the faces in contact from their positions in the state [m]
  double depth = 0;       ///< depth as in GapError [m]
  double negligible = 0;  ///< limit of both [m]

  bool is_met() const { return distance <= negligible && depth <= negligible; }
};
/// Computes the nearness (collective).
Nearness nearness(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete,
                  const solution::NodalSolution& solution);

/// The loop of one mesh. A step moves the state to the solution. If the distance to the solution does not decrease,
/// later steps go half the previous part of the way. Therefore the loop converges or reports that it does not.
class Relinearisation {
 public:
  Relinearisation(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete);

  /// Returns the next state of linearisation; nothing at the end of the loop (collective).
  std::optional<assembly::State> next(const solution::NodalSolution& solution);
  /// Whether the last solution agrees with the state of its linearised gaps, or need not agree.
  bool is_met() const { return is_met_; }
  int steps() const { return steps_; }

 private:
  const problem::Linearisation& settings_;
  const assembly::DiscreteShell& discrete_;
  bool is_met_ = true;
  int steps_ = 1;
  double part_ = 1, last_ = 0;
};

}  // namespace plastron::computation
