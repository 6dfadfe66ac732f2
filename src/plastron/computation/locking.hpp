// Warns of elements without tying (M22) that are too large for the thickness: their displacements are far too small.
#pragma once
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::computation {

/// Returns one warning, in words for the user, if the finest mesh of a problem is so coarse that its elements lock.
/// Empty with tying. Each rank checks the whole problem. Precondition: a regular chart and a positive thickness.
std::vector<std::string> locking_warnings(const problem::Problem& problem);

}  // namespace plastron::computation
