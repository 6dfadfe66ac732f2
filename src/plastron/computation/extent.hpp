// The length of a shell, used as unit of length.
#pragma once
#include <plastron/computation/problem.hpp>

namespace plastron::computation {

/// Returns L, half the diagonal of the box around the mid-surface [m], from the corners of some hundred cells. It is
/// the same for every mesh and rank.
double extent(const Problem& problem);

}  // namespace plastron::computation
