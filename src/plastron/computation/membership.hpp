// Whether a solution that somebody hands over is of the kind that its case asks for: in the discrete space, tangent,
// linearised where the case wants it, under the case's load. The certificate sees none of this, for solve() makes no
// other solutions.
#pragma once
#include <plastron/certificate/certificate_limits.hpp>
#include <plastron/computation/problem.hpp>

#include <vector>

namespace plastron::computation {

/// (collective) The rows that have a meaning in the problem.
std::vector<certificate::CertificateLimit> membership_rows(const Problem& problem,
                                                           const assembly::DiscreteShell& discrete,
                                                           const certificate::NodalSolution& solution,
                                                           const certificate::Summary& summary);

}  // namespace plastron::computation
