// The sides of a surface's triangles in an order in which equal ones follow each other.
#pragma once
#include <plastron/obstacle/triangle_mesh.hpp>

namespace plastron::obstacle {

/// A side from corner to corner as a triangle runs through it, and the triangle.
struct TriangleSide {
  int low, high, triangle;
  bool rises;

  bool is_same(const TriangleSide& other) const { return low == other.low && high == other.high; }
};

std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh);

/// Of the box along the axes that holds all points [m].
double diagonal(const TriangleMesh& mesh);

}  // namespace plastron::obstacle
