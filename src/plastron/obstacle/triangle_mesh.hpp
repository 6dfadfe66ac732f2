// A surface of triangles: points and the three corners of each, counted from 0, anticlockwise seen from outside.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace plastron::obstacle {

struct TriangleMesh {
  std::vector<geometry::Vector3d> points{};  ///< [m]
  std::vector<std::array<int, 3>> triangles{};
  std::size_t joined = 0;  ///< points that join_near_points has made one with another
  double joined_over = 0;  ///< the farthest of them from it [m]
};

inline constexpr std::size_t most_triangles = 2'000'000;

/// Reads .stl (ASCII or binary), .obj or .ply (ASCII or binary), as the name's end says; polygons are cut into triangles from their first
/// corner.
/// Equal points become one, and nearly equal ones (join_near_points); triangles with two equal corners go. Throws
/// ObstacleError: no such file, no such format, damaged,
/// numbers that are not finite, more than most_triangles.
TriangleMesh read_triangle_mesh(const std::string& path);

/// Points at open sides that are this near to each other are one, as a part of the diagonal of the box around all
/// points: coordinates of six digits are not more certain. Short sides make the distance smaller (triangle_sides.hpp).
inline constexpr double joining_tolerance = 1e-6;

/// Joins such points, drops triangles that have lost a side by that, and notes both in the mesh. A closed surface stays
/// as it is.
void join_near_points(TriangleMesh& mesh);

/// Throws ObstacleError, `name` in front, unless the triangles are the boundary of a body: each has an area; each side is one of
/// exactly two, which run through it in opposite senses; no part is turned inside out. (That they do not cross is seen to by
/// TriangleSurface.)
void check_closed(const TriangleMesh& mesh, const std::string& name);

}  // namespace plastron::obstacle
