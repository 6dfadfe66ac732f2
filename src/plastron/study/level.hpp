// One mesh of the sequence: discretise, assemble, solve the contact problem, certify.
#pragma once
#include <plastron/contact/settings.hpp>
#include <plastron/study/observer.hpp>
#include <plastron/study/result.hpp>

#include <memory>
#include <optional>

namespace plastron::study {

struct LevelTask {
  int number = 0;
  std::shared_ptr<const fem::Space> space{};
  contact::Settings settings{};
  std::optional<algebra::Vector> touched{};  ///< contact zone of the mesh before, interpolated; empty on the coarsest
  double seconds_for_mesh = 0;
};

struct LevelResult {
  Level record;
  Solution solution;
  assembly::Verdict verdict;
};

/// (collective)
LevelResult solve_level(const LevelTask& task, const assembly::ShellDescription& shell,
                        std::shared_ptr<const fem::Surface> surface, const Observer& observer);

}  // namespace plastron::study
