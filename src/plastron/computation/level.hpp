// One mesh of the sequence: discretise, assemble, solve the contact problem, certify.
#pragma once
#include <plastron/computation/observer.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/contact/settings.hpp>

#include <memory>
#include <optional>

namespace plastron::computation {

struct LevelTask {
  int number = 0;
  std::shared_ptr<const fem::Space> space{};
  contact::Settings settings{};
  Linearisation linearisation{};
  std::optional<algebra::Vector> touched{};  ///< contact zone of the mesh before, interpolated; empty on the coarsest
  assembly::State start{};                   ///< what the gaps are linearised at first
  double seconds_for_mesh = 0;
};

struct LevelResult {
  Level record;
  Solution solution;
  certificate::Verdict verdict;
};

/// What a solution itself tells of a level, whoever found it (collective).
Level measured(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& solution,
               const certificate::Verdict& verdict);

/// (collective)
LevelResult solve_level(LevelTask task, const assembly::ShellDescription& shell,
                        std::shared_ptr<const fem::Surface> surface, const Observer& observer);

}  // namespace plastron::computation
