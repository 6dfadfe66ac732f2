// A surface of triangles, as drawing programs write it: points, and three corners for each triangle, counted from 0,
// anticlockwise seen from outside.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace plastron::geometry {

struct TriangleMesh {
  std::vector<Vector3d> points{};  ///< [m]
  std::vector<std::array<int, 3>> triangles{};
  std::vector<std::string> groups{};  ///< names of the solids or groups of the file; empty if it has none
  std::vector<int> group_of{};        ///< index into `groups` of each triangle, or -1; empty without groups
  std::size_t joined = 0;             ///< number of points that join_near_points joined to another
  double joined_over = 0;             ///< largest distance between joined points [m]
};

inline constexpr std::size_t most_triangles = 2'000'000;

/// Reads .stl (ASCII or binary), .obj or .ply (ASCII or binary), selected by the end of the name. Cuts polygons into
/// triangles from their first corner. Joins equal and nearly equal points (join_near_points), and drops triangles
/// with two equal corners. Solids of an ASCII .stl and groups (g, o) of an .obj are groups if they have names.
/// Throws FileError: no such file, no such format, damaged, numbers that are not finite, more than most_triangles.
TriangleMesh read_triangle_mesh(const std::string& path);
/// Returns true if the name ends as one of a file that read_triangle_mesh reads, in small or capital letters.
bool is_triangle_file(const std::string& path);

/// Points at open sides within this distance are joined. It is relative to the diagonal of the box around all points,
/// because coordinates of six digits are not more accurate.
inline constexpr double joining_tolerance = 1e-6;
/// Returns this distance for a mesh [m]: joining_tolerance of the diagonal, but at most a hundredth of the median side. A
/// single distant point, placed by mistake, makes the diagonal long.
double joining_distance(const TriangleMesh& mesh);

/// Joins points that are not farther apart than joining_distance, drops triangles that lost a side by this, and
/// records both in the mesh. Does not change a closed surface.
void join_near_points(TriangleMesh& mesh);
/// The same with a distance that is given [m].
void join_near_points(TriangleMesh& mesh, double tolerance);

/// A side from corner to corner in the direction of its triangle, and the triangle.
struct TriangleSide {
  int low, high, triangle;
  bool rises;

  bool is_same(const TriangleSide& other) const { return low == other.low && high == other.high; }
};

/// Returns the sides of all triangles in an order in which equal ones are consecutive.
std::vector<TriangleSide> sorted_sides(const TriangleMesh& mesh);

}  // namespace plastron::geometry
