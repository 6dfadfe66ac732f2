// Examines a problem short of solving it: chart, normals, thickness, initial gap, supports, probes.
#pragma once
#include <plastron/computation/problem.hpp>

#include <string>
#include <vector>

namespace plastron::examination {

enum class Severity { note, warning, error };

/// One thing found, in words for the user: where, what was found, what is allowed, what to do.
struct Finding {
  Severity severity;
  std::string text;
};

/// Everything found, errors included; a problem with errors is not to be solved. Communicates with nobody: one rank may examine for all.
std::vector<Finding> examine(const computation::Problem& problem);

bool has_errors(const std::vector<Finding>& findings);

}  // namespace plastron::examination
