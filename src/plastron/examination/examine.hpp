// Examines a problem without solving it: chart, normals, thickness, initial gap, supports, probes.
#pragma once
#include <plastron/domain/surface_mesh.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::examination {

enum class Severity { note, warning, error };

/// One finding, in words for the user: the place, the finding, the allowed values, the advice.
struct Finding {
  Severity severity;
  std::string text;
};

/// Returns all findings, including errors; a problem with errors must not be solved. It does not communicate: one rank
/// may examine for all.
std::vector<Finding> examine(const problem::Problem& problem);

/// Returns what a mesh in space consists of, and what is doubtful in it.
std::vector<Finding> surface_findings(const domain::FileSurface& surface, bool names_units = false);

bool has_errors(const std::vector<Finding>& findings);

}  // namespace plastron::examination
