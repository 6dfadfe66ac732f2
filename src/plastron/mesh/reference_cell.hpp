// The two reference cells, the unit square and the triangle (0,0), (1,0), (0,1), and functions that depend only on
// them.
//
// Corners are in the order of CoarseCell::vertices: (0,0), (1,0), (0,1), (1,1) in the square, anticlockwise in the
// triangle. Nodes of both are numbered lexicographically, xi_1 fastest. Sides of the square, 0: xi_1 = 0, 1: xi_1 =
// 1, 2: xi_2 = 0, 3: xi_2 = 1, run with the increasing coordinate. Side s of the triangle runs from corner s to the
// next.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace plastron::mesh {

using Eigen::Vector2d;

enum class Shape { quadrilateral, triangle };

/// Number of corners, equal to the number of sides.
int corner_count(Shape shape);
Vector2d corner(Shape shape, int k);
Vector2d centre(Shape shape);

/// Number of nodes of the element of degree k: (k+1)^2 or (k+1)(k+2)/2.
int nodes_per_cell(Shape shape, int degree);
/// Equidistant points, n intervals per side, xi_1 fastest.
std::vector<Vector2d> lattice(Shape shape, int n);

/// Whether xi lies in the reference cell, or outside by at most the tolerance.
bool holds(Shape shape, const Vector2d& xi, double tolerance);
/// Moves a point that lies outside only by rounding back to the edge.
Vector2d put_inside(Shape shape, const Vector2d& xi);

/// The two corners of a side, in its direction.
std::array<int, 2> side_corners(Shape shape, int side);
/// The same two corners in anticlockwise order round the cell.
std::array<int, 2> anticlockwise_corners(Shape shape, int side);
/// Indices of the nodes on a side, in its direction.
std::vector<int> side_nodes(Shape shape, int degree, int side);
/// The point at parameter t of a side, 0 <= t <= 1.
Vector2d side_point(Shape shape, int side, double t);
/// d xi / dt along a side, with the sign of the anticlockwise direction round the cell.
Vector2d side_tangent(Shape shape, int side);

}  // namespace plastron::mesh
