// The surface of a body as triangles (geometry/triangle_mesh.hpp), and what it takes to be one.
#pragma once
#include <plastron/geometry/triangle_mesh.hpp>

#include <string>

namespace plastron::obstacle {

using geometry::TriangleMesh, geometry::TriangleSide;

/// Checks that the triangles are the boundary of a body. Throws ObstacleError with `name` in front otherwise. Each
/// triangle must have an area. Each side must belong to exactly two triangles, which traverse it in opposite senses.
/// No part may be turned inside out. (TriangleSurface checks that triangles do not cross.)
void check_closed(const TriangleMesh& mesh, const std::string& name);

}  // namespace plastron::obstacle
