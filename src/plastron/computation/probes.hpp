// Results at named points of Omega.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>

#include <vector>

namespace plastron::computation {

/// The same values on every rank (collective). Throws fem::DomainError for a point outside of Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<Probe>& probes);

}  // namespace plastron::computation
