// A functional at a solution: its value and its derivative, from which the dual problem is made.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/certificate/singular_places.hpp>
#include <plastron/estimation/dual_solver.hpp>
#include <plastron/estimation/functionals.hpp>
#include <plastron/recovery/resultant_patches.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::estimation {

/// A solution on the last mesh with what its contact problem was solved with.
struct Solved {
  const assembly::DiscreteShell& discrete;
  const certificate::NodalSolution& nodal;
  const contact::BoxProblem& box;
  const contact::BoxSolution& z;
  std::vector<certificate::SingularPlace> singular{};                   ///< that the largest stress leaves out
  mutable std::shared_ptr<const recovery::ResultantPatches> patches{};  ///< made when they are wanted first

  const std::shared_ptr<const recovery::ResultantPatches>& recovered() const;  ///< (collective)
};

struct Derivative {
  double value = 0;
  DualLoad dual;
  bool weighs_gaps = false;  ///< reactions are weighed with the gap of the undeformed shell: that of the energy
  Eigen::Vector3d force_direction = Eigen::Vector3d::Zero();  ///< reactions of `obstacle` are weighed along it
  std::optional<std::size_t> obstacle{};                      ///< empty: of all

  /// Where the dual is held at a touching point.
  double held_at(std::size_t which, const obstacle::Gap& gap) const {
    if (weighs_gaps) return gap.initial;
    return obstacle && *obstacle != which ? 0 : -gap.normal.dot(force_direction);
  }
};

/// (collective) Precondition: names in the functional exist, points lie in the domain.
Derivative derivative(const Functional& functional, const Solved& solved);
/// Of each goal (collective).
std::vector<double> values(std::span<const Goal> goals, const Solved& solved);

}  // namespace plastron::estimation
