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

/// Points at open sides that are this near to each other are one [m]: joining_tolerance of the diagonal, but at most a hundredth of the median
/// side. A point that lies far out by mistake makes the diagonal long.
double joining_distance(const TriangleMesh& mesh);

}  // namespace plastron::obstacle
