// A functional at a solution: its value and its derivative, which is the load of the dual problem.
#pragma once
#include <plastron/estimation/dual_solver.hpp>
#include <plastron/estimation/functionals.hpp>
#include <plastron/recovery/resultant_patches.hpp>
#include <plastron/recovery/singular_places.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::estimation {

/// A solution on the last mesh with its contact problem.
struct Solved {
  const assembly::DiscreteShell& discrete;
  const solution::NodalSolution& nodal;
  const contact::BoxProblem& box;
  const contact::BoxSolution& z;
  std::vector<recovery::SingularPlace> singular{};                      ///< places that the largest stress leaves out
  mutable std::shared_ptr<const recovery::ResultantPatches> patches{};  ///< made at first use

  /// The patches of the solution, made at the first call (collective).
  const std::shared_ptr<const recovery::ResultantPatches>& recovered() const;
};

struct Derivative {
  double value = 0;
  DualLoad dual;
  /// Factor of the energy of the error in J(u) - J(u_h): of the energy, 1 where it needs no dual for loads; -1 where the dual of the
  /// forces of its stresses gives W'(u)[e], from which this part is subtracted.
  double energy_part = 0;
  bool weighs_gaps = false;  ///< true for the energy: reactions are weighted with the gap of the undeformed shell
  /// Direction along which reactions of `obstacle` are weighted.
  Eigen::Vector3d force_direction = Eigen::Vector3d::Zero();
  std::optional<std::size_t> obstacle{};  ///< empty: all obstacles

  /// The value at which the dual is fixed at a touching point.
  double held_at(std::size_t which, const obstacle::Gap& gap) const {
    if (weighs_gaps) return gap.initial;
    return obstacle && *obstacle != which ? 0 : -gap.normal.dot(force_direction);
  }
};

/// Returns a derivative without value, loads and weights.
Derivative zero_derivative(const Solved& solved);

/// Returns value and derivative (collective). Precondition: names in the functional exist, points lie in the domain.
Derivative derivative(const Functional& functional, const Solved& solved);
// Functionals at a point (point_values.cc). A force at a point has infinite energy in Naghdi's model, which grows like a
// logarithm. A couple and a resultant have infinite energy too, with faster growth.
Derivative derivative_of(const PointDisplacement& point, const Solved& solved);
Derivative derivative_of(const PointStress& point, const Solved& solved);
Derivative derivative_of(const LargestStress& stress, const Solved& solved);

/// Returns the value of each goal (collective).
std::vector<double> values(std::span<const Goal> goals, const Solved& solved);

}  // namespace plastron::estimation
