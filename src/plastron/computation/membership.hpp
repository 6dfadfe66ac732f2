// Checks whether a given solution belongs to its case: in the discrete space, tangent,
// linearised as the case requires, under the case's load. The certificate does not check this, because solve() makes
// only such solutions.
#pragma once
#include <plastron/certificate/certificate_limits.hpp>
#include <plastron/problem/problem.hpp>

#include <vector>

namespace plastron::computation {

/// Returns the rows that have a meaning in the problem (collective).
std::vector<certificate::CertificateLimit> membership_rows(const problem::Problem& problem,
                                                           const assembly::DiscreteShell& discrete,
                                                           const solution::NodalSolution& solution,
                                                           const solution::Summary& summary);

}  // namespace plastron::computation
