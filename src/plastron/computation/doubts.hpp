// Warnings about a result from the computed data: whether the certificate confirms it, and where the model or the
// mesh reaches its limits.
#pragma once
#include <plastron/computation/left_out.hpp>
#include <plastron/contact/settings.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Warns where the linear model omits a notable part of the energy, at the worst instant, or where the shell would
/// buckle. Precondition: a level was solved.
std::vector<std::string> linear_model_warnings(const Result& result);

/// Returns a part of an energy as per cent, as long as this is meaningful: rigid motions have almost no energy.
std::string percent(double part);

/// Warns of strains beyond the range of the linear material law; needs the stress peak.
std::vector<std::string> strain_warnings(const Result& result);

/// Warns of nodes that were deep inside an obstacle and were pushed out along the shell instead of across it. Their
/// nearest surface at the start may have been the wrong one.
std::vector<std::string> sideways_warnings(const solution::Summary& summary);

/// Warns of rigid bodies that move their nodes into obstacles.
std::vector<std::string> body_warnings(const solution::Summary& summary);

/// Sets the limits of the result's certificate. A row beyond its limit makes a solved result inaccurate, and is named.
void judge_certificate(Result& result);

/// Warns of penetration between nodes, reactions concentrated on edges, and tolerances that rounding has loosened.
std::vector<std::string> contact_warnings(const Result& result, const contact::Settings& asked);

}  // namespace plastron::computation
