// The outer loop over linearised gaps (M16): solve, then linearise at the displaced faces, until the linearised gap
// equals the distance of the deformed faces from the obstacles. Planes do not need it because their gap is linear. If
// an obstacle is left out at a node because others are nearer, it is included when the shell has come closer to it. So is the
// exact gap of an obstacle on the other side of the shell. Beds with segments take the segments of the state (M33): the loop goes on
// until each node lies on its own.
#pragma once
#include <plastron/problem/problem.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <deque>
#include <optional>
#include <vector>

namespace plastron::computation {

/// Rotation beyond which a solution of the linear model is no state of a shell, and no gap of a curved obstacle means anything [rad].
constexpr double meaningless_rotation = 10;

/// Difference between the linearised gaps and the distances of the deformed faces (collective).
struct GapError {
  double at_contact = 0;  ///< largest |distance - gap| of the faces that touch [m]
  double depth = 0;       ///< largest depth of a face at a node inside an obstacle [m]
};
GapError gap_error(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution);

/// Whether another linearisation can be needed: there are curved obstacles, a bed with segments, or rows without an exact bound that
/// may become relevant (collective).
bool has_rows_to_meet(const assembly::DiscreteShell& discrete);

/// Distance of a solution from the state at which its gaps were linearised.
struct Nearness {
  double distance = 0;  ///< largest distance of the faces in contact from their positions in the state [m]
  double depth = 0;     ///< depth as in GapError [m]
  double closure = 0;   ///< largest difference between the closure of a bed and that of its law under the pressure [m]
  double negligible = 0;  ///< limit of all three [m]

  bool is_met() const { return distance <= negligible && depth <= negligible && closure <= negligible; }
};
/// Least thickness at nodes (collective) [m].
double least_thickness(const assembly::DiscreteShell& discrete);

/// Computes the nearness (collective).
Nearness nearness(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete,
                  const solution::NodalSolution& solution);

/// The loop of one mesh. A step moves the state to the solution. This converges slowly beside edges and corners of obstacles, where the
/// turn of a face moves its gap. So each step is corrected by the last ones (Anderson's acceleration): by the combination of their
/// changes that cancels most of the way to the solution. If the solution is not nearer after a step, the part of the way is halved, down
/// to 1/16; else it is doubled, up to 1. After three such steps the changes are forgotten. The loop converges or reports that it does not.
/// A bed with segments takes the segments of the state. A step that leaves them is shortened to the least potential along it, and planes
/// need no other correction: the potential is convex, so no segments come twice.
class Relinearisation {
 public:
  Relinearisation(const problem::Linearisation& settings, const assembly::DiscreteShell& discrete);

  /// Returns the next state of linearisation; nothing at the end of the loop (collective).
  std::optional<assembly::State> next(const solution::NodalSolution& solution);
  /// Whether the last solution agrees with the state of its linearised gaps, or need not agree.
  bool is_met() const { return is_met_; }
  int steps() const { return steps_; }

 private:
  /// A state and the way from there to its solution: (u, r) of local nodes, then positions of pressed obstacles.
  struct Iterate {
    std::vector<double> at{}, way{};
  };
  Iterate iterate(const solution::NodalSolution& solution) const;
  /// Adds to a step what cancels as much of the way as the last iterates show (collective).
  void correct(const Iterate& now, std::vector<double>& step) const;
  /// Product of the displacements of owned nodes (collective).
  double product(const std::vector<double>& a, const std::vector<double>& b) const;

  const problem::Linearisation& settings_;
  const assembly::DiscreteShell& discrete_;
  bool is_met_ = true;
  int steps_ = 1;
  int farther_ = 0;  ///< number of the last steps after which the solution was farther away
  double part_ = 1, last_ = 0;
  std::deque<Iterate> iterates_{};  ///< the last ones, of deformed states
};

}  // namespace plastron::computation
