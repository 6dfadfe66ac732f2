// The nodes of the coarsest mesh that every finer one has, too: a support at a point must be held on all of them.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <vector>

namespace plastron::fem {

/// Corners of the cells, and where the degree is even the middles of their sides and of quadrilaterals: other nodes move
/// when a cell is divided. Some are listed more than once.
std::vector<Vector2d> kept_nodes(const CoarseMesh& coarse, int degree);

/// Points of Omega that are no farther apart are one: 1e-9 of the longest side of the box that holds the vertices.
double point_tolerance(const CoarseMesh& coarse);

}  // namespace plastron::fem
