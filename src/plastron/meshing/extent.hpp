// The length of a shell, used as unit of length.
#pragma once
#include <plastron/problem/problem.hpp>

namespace plastron::meshing {

/// Returns L, half the diagonal of the box around the mid-surface [m], from the corners of some hundred cells. It is
/// the same for every mesh and rank.
double extent(const problem::Problem& problem);

}  // namespace plastron::meshing
