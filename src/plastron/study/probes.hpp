// Results at named points of Omega.
#pragma once
#include <plastron/study/problem.hpp>
#include <plastron/study/result.hpp>

#include <vector>

namespace plastron::study {

/// The same values on every rank (collective). Throws fem::DomainError for a point outside of Omega.
std::vector<ProbeValue> probe(const Solution& solution, const std::vector<Probe>& probes);

}  // namespace plastron::study
