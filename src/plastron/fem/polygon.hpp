// Measures of polygons, and Gmsh's mesh of one.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

namespace plastron::fem {

/// Positive where the corners run anticlockwise.
double signed_area(const Polygon& polygon);
double perimeter(const Polygon& polygon);
/// Twice the area over the perimeter: the radius of the circle that touches all sides, where there is one.
double inner_width(const Polygon& polygon);
/// Without corners that are nearly straight.
bool is_convex_quadrilateral(const Polygon& polygon);

/// Cells of about a length; quadrilaterals have half of it, since they are triangles divided.
CoarseMesh gmsh_polygon(const Polygon& polygon, Shape shape, double length);

}  // namespace plastron::fem
