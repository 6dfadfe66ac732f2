// A solved shell for the tests of estimation/, with all that a dual problem needs.
#pragma once
#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/estimation/derivatives.hpp>
#include <plastron/estimation/dual_solver.hpp>
#include <plastron/estimation/estimate.hpp>
#include <plastron/estimation/kept_factorisation.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assembly/sample_shells.hpp"

namespace plastron::test {

class SolvedShell {
 public:
  SolvedShell(const MeshedSurface& mesh, const assembly::ShellDescription& shell, assembly::State state = {})
      : discrete_(assembly::discretise(mesh.space, mesh.surface, shell, std::move(state))),
        matrix_(assembly::stiffness_matrix(*discrete_)),
        factor_(matrix_),
        kept_(factor_, mesh.space->layout->comm),
        box_(assembly::box_problem(*discrete_, matrix_)),
        z_(contact::solve(box_, {}, kept_)),
        nodal_(solution_of(*discrete_, z_)) {
    EXPECT_EQ(z_.status, contact::Status::solved);
    kept_.keep();
  }

  estimation::Solved solved() const { return {.discrete = *discrete_, .nodal = nodal_, .box = box_, .z = z_}; }
  estimation::Derivative derivative_of(const estimation::Functional& functional) const {
    return estimation::derivative(functional, solved());
  }
  double value(const estimation::Functional& functional) const { return derivative_of(functional).value; }
  /// The solution of the functional's dual problem.
  std::optional<estimation::DualSolution> dual(const estimation::Functional& functional) {
    return dual(derivative_of(functional).dual);
  }
  std::optional<estimation::DualSolution> dual(const estimation::DualLoad& load) {
    return estimation::DualSolver(box_, z_, kept_).solve(load);
  }
  estimation::Estimates estimates(const std::vector<estimation::Goal>& goals) {
    return estimation::estimate(solved(), kept_, goals);
  }

  const assembly::DiscreteShell& discrete() const { return *discrete_; }
  const contact::BoxProblem& box() const { return box_; }
  const contact::BoxSolution& solution() const { return z_; }
  const solution::NodalSolution& nodal() const { return nodal_; }

 private:
  /// Moves the pressed obstacles to their positions in z, too.
  static solution::NodalSolution solution_of(assembly::DiscreteShell& discrete, const contact::BoxSolution& z) {
    if (!z.positions.empty()) assembly::press(discrete, z.positions);
    return solution::nodal_solution(discrete, z);
  }

  std::unique_ptr<assembly::DiscreteShell> discrete_;
  algebra::Matrix matrix_;
  algebra::Factorisation factor_;
  estimation::KeptFactorisation kept_;
  contact::BoxProblem box_;
  contact::BoxSolution z_;
  solution::NodalSolution nodal_;
};

}  // namespace plastron::test
