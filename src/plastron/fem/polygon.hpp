// Measures of a polygon, and its mesh made by Gmsh.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

namespace plastron::fem {

/// The area, positive if the corners run anticlockwise.
double signed_area(const Polygon& polygon);
double perimeter(const Polygon& polygon);
/// Twice the area over the perimeter: the radius of the inscribed circle if one touches all sides.
double inner_width(const Polygon& polygon);
/// Whether the polygon is a convex quadrilateral without nearly straight corners.
bool is_convex_quadrilateral(const Polygon& polygon);

/// Meshes with cells of about `length`. Quadrilaterals have half this size because they are divided triangles.
CoarseMesh gmsh_polygon(const Polygon& polygon, Shape shape, double length);

}  // namespace plastron::fem
