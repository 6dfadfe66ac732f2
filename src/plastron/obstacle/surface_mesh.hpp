// An obstacle's surface as triangles, for drawing.
#pragma once
#include <plastron/obstacle/obstacle.hpp>

namespace plastron::obstacle {

/// Returns the part of the obstacle's surface within `extent`. A half-space is a rectangle that may extend beyond. A
/// TriangleSurface gives its own triangles. Other shapes are sampled on a grid of `intervals` cells per side over the
/// part of `extent` that they reach. Their points are on the surface; edges are cut off by less than a cell.
/// Triangles are anticlockwise seen from the free side; triangles with their middle outside of `extent` are omitted.
TriangleMesh surface_mesh(const Obstacle& obstacle, const Extent& extent, int intervals = 48);

}  // namespace plastron::obstacle
