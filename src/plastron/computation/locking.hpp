// Elements without tying (M22) that are too large for the thickness give displacements that are far too small.
#pragma once
#include <plastron/computation/problem.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// One warning, in words for the user, if the finest mesh of a problem is so coarse that its elements lock; empty with
/// tying. Each rank looks at the whole problem for itself. Precondition: a regular chart and a positive thickness.
std::vector<std::string> locking_warnings(const Problem& problem);

}  // namespace plastron::computation
