// Values of a solution at points that the case names.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

#include <vector>

namespace plastron::computation {

/// Values at points of Omega, the same on every rank; where cells meet, those of the lowest rank's first one (collective). Throws
/// fem::DomainError for points outside of Omega, naming them as `what`.
std::vector<recovery::PointValues> values_at(const Solution& solution, const std::vector<Eigen::Vector2d>& points,
                                             std::string_view what);

/// (collective) Throws fem::DomainError for probes outside of Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<Probe>& probes);

}  // namespace plastron::computation
