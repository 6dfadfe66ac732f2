// Values of a solution at the points that a case names.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>

#include <vector>

namespace plastron::computation {

/// Sets solution.recovery according to the problem. Call it again when the solution changes (collective).
void choose_recovery(const problem::Output& output, Solution& solution);

/// Sets result.peak and result.singular_places from its solution and summary. Call it after choose_recovery()
/// (collective).
void find_stress_peak(Result& result);

/// Returns values at points of Omega, equal on every rank. Where cells meet, the first cell of the lowest rank is used
/// (collective). Throws fem::DomainError for points outside Omega, named as `what`.
std::vector<recovery::PointValues> values_at(const Solution& solution, const std::vector<Eigen::Vector2d>& points,
                                             std::string_view what);

/// Returns the probe values (collective). Throws fem::DomainError for probes outside Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<problem::Probe>& probes);

}  // namespace plastron::computation
