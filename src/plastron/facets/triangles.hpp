// Areas and normals of triangles.
#pragma once
#include <plastron/geometry/triangle_mesh.hpp>

#include <array>

namespace plastron::facets {

using geometry::TriangleMesh, geometry::Vector3d;

/// Area of all triangles [m^2].
double area_of(const TriangleMesh& mesh);
/// Returns the normal of a triangle, whose length is twice the area [m^2].
Vector3d normal_of(const TriangleMesh& mesh, const std::array<int, 3>& triangle);

}  // namespace plastron::facets
