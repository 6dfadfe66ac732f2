// The error of a computed solution against an exact one, and observed rates.
#pragma once
#include "verification/manufactured.hpp"

#include <plastron/computation/result.hpp>

#include <vector>

namespace plastron::verification {

/// |U - U_h| / |U| in the energy norm of (M8). Strains of U_h are those of the method (tied where tying is on),
/// compared with the exact ones at (k + 3)^2 Gauss points of every cell, collapsed ones on triangles. These are no
/// special points of the element.
double energy_error(const computation::Solution& solution, const Manufactured& exact);

/// |U - U_h| / |U| in L2, u and r together.
double l2_error(const computation::Solution& solution, const Manufactured& exact);

/// log2 of the ratios of successive errors.
std::vector<double> rates(const std::vector<double>& errors);

/// Returns whether the discrete problem is solved. On coarse given meshes an obstacle may still pass too deep between
/// nodes, which the program reports as `inaccurate`.
bool is_solved_at_nodes(const computation::Result& result);

}  // namespace plastron::verification
