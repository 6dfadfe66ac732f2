// What to doubt in a result, read off what was computed: whether its certificate bears it out, and where the model's or the
// mesh's limits show.
#pragma once
#include <plastron/computation/left_out.hpp>
#include <plastron/contact/settings.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Where the linear model leaves out a notable part of the energy, at the worst of all instants, or the shell would buckle.
/// Precondition: a level was solved.
std::vector<std::string> linear_model_warnings(const Result& result);

/// A part of an energy as per cent, as far as per cent tell something: rigid motions have no energy to speak of.
std::string percent(double part);

/// Strains beyond what the linear law of materials is good for; needs the stress peak.
std::vector<std::string> strain_warnings(const Result& result);

/// Nodes that were deep inside of an obstacle and were pushed out of it along the shell and not across it: their nearest surface at the
/// start may have been the wrong one.
std::vector<std::string> sideways_warnings(const certificate::Summary& summary);

/// Rigid bodies that take their nodes into obstacles.
std::vector<std::string> body_warnings(const certificate::Summary& summary);

/// Sets the limits of the result's certificate. A row beyond its limit makes a solved result inaccurate, and is named.
void judge_certificate(Result& result);

/// Penetration between nodes, reactions concentrated on edges, tolerances that rounding has loosened.
std::vector<std::string> contact_warnings(const Result& result, const contact::Settings& asked);

}  // namespace plastron::computation
