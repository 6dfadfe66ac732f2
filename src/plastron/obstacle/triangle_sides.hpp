// The sides of a surface's triangles in an order in which equal ones are consecutive.
#pragma once
#include <plastron/obstacle/triangle_mesh.hpp>

namespace plastron::obstacle {

/// A side from corner to corner in the direction of its triangle, and the triangle.
struct TriangleSide {
  int low, high, triangle;
  bool rises;

  bool is_same(const TriangleSide& other) const { return low == other.low && high == other.high; }
};

std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh);

/// Points at open sides within this distance are joined [m]: joining_tolerance of the diagonal, but at most a
/// hundredth of the median side. A single distant point, placed by mistake, makes the diagonal long.
double joining_distance(const TriangleMesh& mesh);

}  // namespace plastron::obstacle
