// Areas and normals of triangles.
#pragma once
#include <plastron/geometry/triangle_mesh.hpp>

#include <algorithm>
#include <array>

namespace plastron::facets {

using geometry::TriangleMesh, geometry::Vector3d;

/// The two corners of a side, ascending.
using Ends = std::array<int, 2>;
inline Ends ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Area of all triangles [m^2].
double area_of(const TriangleMesh& mesh);
/// Returns the normal of a triangle, whose length is twice the area [m^2].
Vector3d normal_of(const TriangleMesh& mesh, const std::array<int, 3>& triangle);

}  // namespace plastron::facets
