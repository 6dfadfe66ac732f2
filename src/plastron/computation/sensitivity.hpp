// How a solution changes with the case: solutions of changed problems next to it, with its factor, on the same mesh and with the
// same nodes in contact. Differences of their numbers are derivatives.
#pragma once
#include <plastron/computation/level_run.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/estimation/dual_solver.hpp>
#include <plastron/problem/problem.hpp>

#include <memory>
#include <stdexcept>
#include <string>

namespace plastron::computation {

/// There is no solution next to the given one, with the reason for the user.
struct SensitivityError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

class Sensitivity {
 public:
  /// Factorises the tangent of the solution (collective). Keeps references to both. Throws SensitivityError for results and problems
  /// whose equations are others: results that are not solved, the mixed formulation, pressed obstacles, loads that follow a
  /// displacement; with small rotations also curved obstacles and loaded results.
  Sensitivity(const problem::Problem& problem, const Result& result);

  /// Returns the result for a changed problem, without certificate, estimates, stability and modes: Newton steps with the factor
  /// of the solution, until the equilibrium holds (collective). Throws SensitivityError if the change is too large or changes the
  /// domain, and the errors of solve().
  Result at(const problem::Problem& changed) const;

 private:
  std::unique_ptr<assembly::DiscreteShell> discretised(const problem::Problem& changed) const;
  Solution near(const problem::Problem& changed) const;

  const problem::Problem& problem_;
  const Result& result_;
  const Solution& solution_;
  std::unique_ptr<LinearAlgebra> algebra_{};
  finite::ProblemAtSolution at_solution_;
  mutable estimation::DualSolver tangent_;  ///< solves the equations of the tangent with the contact held
};

}  // namespace plastron::computation
