// Evaluates a finished solution: limits of the certificate, contact zones, resultants, probes, largest stress.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>

#include <string_view>
#include <vector>

namespace plastron::computation {

/// Sets the limits of the result's certificate. A row beyond its limit makes a solved result inaccurate, and is named.
void judge_certificate(Result& result);

/// Whether nothing loads, strains or moves the shell.
bool is_at_rest(const solution::Summary& summary);

/// With finite rotations, examines whether the solution is stable, and adds its softest motion to the solution's modes. A motion
/// that lowers the energy makes a solved result unstable (collective).
void examine_stability(Result& result, Solution& solution);

/// Adds the contact zones of each obstacle to the summary (collective).
void add_contact_zones(Result& result);

/// Returns the distance between the edges of contact zones of two solutions, relative to the zones' size
/// (solution::relative_distance). It is the largest of all obstacles. Contact along a line has no edge. Therefore
/// obstacles without a cell whose nodes all touch are ignored. Zones narrower than half of the thickness, the width of
/// the layer at an edge, are ignored too. (collective)
double edge_change(const Solution& one, const Solution& other, double least_thickness);

/// Sets solution.recovery according to the problem. Call it again when the solution changes (collective).
void choose_recovery(const problem::Output& output, Solution& solution);

/// Sets result.peak, result.layers and result.singular_places from its solution and summary. Call it after choose_recovery()
/// (collective).
void find_stress_peak(Result& result);

/// Returns values at points of Omega, equal on every rank. Where cells meet, the first cell of the lowest rank is used
/// (collective). Throws mesh::DomainError for points outside Omega, named as `what`.
std::vector<recovery::PointValues> values_at(const Solution& solution, const std::vector<Eigen::Vector2d>& points,
                                             std::string_view what);

/// Returns the probe values (collective). Throws mesh::DomainError for probes outside Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<problem::Probe>& probes);

}  // namespace plastron::computation
