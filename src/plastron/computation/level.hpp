// A discrete shell on one mesh at one instant: assemble, solve the contact problem, repeat the linearisation where
// obstacles are curved, certify.
#pragma once
#include <plastron/computation/level_task.hpp>
#include <plastron/computation/result.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace plastron::computation {

struct LevelResult {
  Level record;
  Solution solution;
  certificate::Verdict verdict;
  std::optional<estimation::Estimates> estimates{};  ///< if requested, for a solution that was found
  std::optional<Passing> passing{};                  ///< set by Run::search_path()
  bool passes = false;                               ///< an obstacle may have passed for the first time
  std::vector<double> values{};                      ///< values of LevelTask::valued, if a solution was found
};

/// Whether the supports alone fix the shell. Then the very first step of the active set succeeded with nothing in
/// contact. First steps of other solvers or of proximal points do not show this.
bool supports_hold(const std::vector<contact::Iteration>& history, const contact::Settings& settings);

/// Returns the data of a level that follow from the solution itself, independent of the solver (collective).
Level measured(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution,
               const certificate::Verdict& verdict);

/// Solves a level. `discrete` is linearised at the first state of the gaps; it becomes the solution's shell
/// (collective).
LevelResult solve_level(const LevelTask& task, std::unique_ptr<assembly::DiscreteShell> discrete,
                        const Observer& observer);

}  // namespace plastron::computation
