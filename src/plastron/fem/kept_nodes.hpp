// Nodes of the coarsest mesh that all finer meshes contain too: a support at a point must exist on all of them.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <vector>

namespace plastron::fem {

/// Corners of the cells; for even degree also the middles of their sides and of quadrilaterals. Other nodes change
/// place when a cell is divided. Some nodes are listed more than once.
std::vector<Vector2d> kept_nodes(const CoarseMesh& coarse, int degree);

/// Points of Omega within this distance are identical: 1e-9 of the longest side of the vertices' bounding box.
double point_tolerance(const CoarseMesh& coarse);

}  // namespace plastron::fem
