// A discrete shell on one mesh at one instant: assemble, solve the contact problem, linearise again where obstacles are curved, certify.
#pragma once
#include <plastron/computation/observer.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>
#include <plastron/estimation/functionals.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace plastron::computation {

struct LevelTask {
  int number = 0;
  contact::Settings settings{};
  Linearisation linearisation{};
  bool admissible = false;                ///< see Problem
  std::optional<algebra::Vector> zone{};  ///< where contact is expected (contact_forecast.hpp); empty at first
  std::optional<std::vector<estimation::Goal>> goals{};  ///< whose errors are estimated, with that of the solution
  std::vector<estimation::Goal> valued{};                ///< whose values alone are wanted
  Seconds seconds{};                                     ///< spent on the mesh and on `discrete`
};

struct LevelResult {
  Level record;
  Solution solution;
  certificate::Verdict verdict;
  std::optional<estimation::Estimates> estimates{};  ///< if asked for, of a solution that was found
  std::vector<double> values{};                      ///< of LevelTask::valued, likewise
};

/// Whether the supports alone hold the shell: then the active set's first step of all went through with nothing in contact. Other solvers'
/// first steps say nothing of the kind, nor do those of proximal points.
bool supports_hold(const std::vector<contact::Iteration>& history, contact::Solver solver);

/// What a solution itself tells of a level, whoever found it (collective).
Level measured(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& solution,
               const certificate::Verdict& verdict);

/// `discrete` is linearised where the gaps shall be at first; it becomes the solution's (collective).
LevelResult solve_level(const LevelTask& task, std::unique_ptr<assembly::DiscreteShell> discrete,
                        const Observer& observer);

}  // namespace plastron::computation
