// The two reference cells, the unit square and the triangle (0,0), (1,0), (0,1), and what depends on them alone.
//
// Corners stand in the order of CoarseCell::vertices: (0,0), (1,0), (0,1), (1,1) of the square, anticlockwise on the
// triangle. Nodes of either are numbered lexicographically, xi_1 fastest. Sides of the square: 0: xi_1 = 0, 1: xi_1 = 1,
// 2: xi_2 = 0, 3: xi_2 = 1, run with the increasing coordinate. Side s of the triangle runs from corner s to the next.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace plastron::fem {

using Eigen::Vector2d;

enum class Shape { quadrilateral, triangle };

/// How many corners, and as many sides.
int corner_count(Shape shape);
Vector2d corner(Shape shape, int k);
Vector2d centre(Shape shape);

/// Nodes of the element of degree k: (k+1)^2 or (k+1)(k+2)/2.
int nodes_per_cell(Shape shape, int degree);
/// Equidistant points, n intervals a side, xi_1 fastest.
std::vector<Vector2d> lattice(Shape shape, int n);

/// True if xi lies in the reference cell, or outside by no more than the tolerance.
bool holds(Shape shape, const Vector2d& xi, double tolerance);
/// A point that lies outside by rounding alone, put back on the edge.
Vector2d put_inside(Shape shape, const Vector2d& xi);

/// The two corners of a side, in its direction.
std::array<int, 2> side_corners(Shape shape, int side);
/// The same two as they follow each other anticlockwise round the cell.
std::array<int, 2> anticlockwise_corners(Shape shape, int side);
/// Indices of the nodes on a side, in its direction.
std::vector<int> side_nodes(Shape shape, int degree, int side);
/// The point at parameter t of a side, 0 <= t <= 1.
Vector2d side_point(Shape shape, int side, double t);
/// d xi / dt along a side, with the sign that runs anticlockwise round the cell.
Vector2d side_tangent(Shape shape, int side);

}  // namespace plastron::fem
