// Values of a solution at points that the case names.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

#include <vector>

namespace plastron::computation {

/// Sets solution.recovery as the problem wants it; to be done again when the solution changes (collective).
void choose_recovery(const Output& output, Solution& solution);

/// Sets result.peak and result.singular_places from its solution and summary; after choose_recovery() (collective).
void find_stress_peak(Result& result);

/// Values at points of Omega, the same on every rank; where cells meet, those of the lowest rank's first one (collective). Throws
/// fem::DomainError for points outside of Omega, naming them as `what`.
std::vector<recovery::PointValues> values_at(const Solution& solution, const std::vector<Eigen::Vector2d>& points,
                                             std::string_view what);

/// (collective) Throws fem::DomainError for probes outside of Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<Probe>& probes);

}  // namespace plastron::computation
