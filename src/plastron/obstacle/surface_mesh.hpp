// An obstacle's surface as triangles, for drawing.
#pragma once
#include <plastron/obstacle/obstacle.hpp>

namespace plastron::obstacle {

/// An axis-parallel box of space.
struct Extent {
  Vector3d low, high;
};

/// The part of the obstacle's surface within `extent`. A half-space is a rectangle that may reach
/// beyond, a TriangleSurface its own triangles, any
/// other shape is found on a grid of `intervals` cells a side over what of `extent` it can reach, with its points on the
/// surface and its edges cut off by less than a cell. Triangles are anticlockwise seen from the free side; those whose middle is outside
/// of `extent` are left out.
TriangleMesh surface_mesh(const Obstacle& obstacle, const Extent& extent, int intervals = 48);

}  // namespace plastron::obstacle
