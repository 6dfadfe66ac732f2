#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/triangle_mesh.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plastron::obstacle {

namespace {

using geometry::Vector3d, geometry::joining_distance, geometry::sorted_sides;
using Triangle = std::array<int, 3>;
using Side = TriangleSide;

std::string shown(const Vector3d& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

void check_areas(const TriangleMesh& mesh, const std::string& name) {
  constexpr double least_sine = 1e-10;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vector3d u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    if (!(u.cross(v).norm() > least_sine * longest))
      throw ObstacleError(fmt::format("{}: triangle {} at {} has no area; remove such triangles (repair the surface)",
                                      name, t + 1, shown(mesh.points[a])));
  }
}

/// Checks that each side belongs to two triangles in opposite senses.
void check_sides(const TriangleMesh& mesh, const std::vector<Side>& sides, const std::string& name) {
  std::size_t open = 0, first_open = 0;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const auto place = [&] {
      return fmt::format("from {} to {}", shown(mesh.points[sides[i].low]), shown(mesh.points[sides[i].high]));
    };
    if (end - i == 1 && open++ == 0) first_open = i;
    if (end - i > 2)
      throw ObstacleError(
          fmt::format("{}: {} triangles meet in the side {}; the surface must be that of one body, "
                      "where two do",
                      name, end - i, place()));
    if (end - i == 2 && sides[i].rises == sides[i + 1].rises)
      throw ObstacleError(fmt::format(
          "{}: the triangles on the side {} are not turned alike; orient all of them outward", name, place()));
  }
  if (open > 0)
    throw ObstacleError(
        fmt::format("{}: the surface is not closed: {} sides have one triangle only, the first from {} "
                    "to {}; close it, or join points that should be one (points there are joined up to {:.2g} m: a "
                    "millionth of the surface's size, at most a hundredth of the median side)",
                    name, open, shown(mesh.points[sides[first_open].low]), shown(mesh.points[sides[first_open].high]),
                    joining_distance(mesh)));
}

/// The part of each triangle, counted from 0. Triangles connected by sides have the same number.
std::vector<int> parts(const TriangleMesh& mesh, const std::vector<Side>& sides) {
  std::vector<int> root(mesh.triangles.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
  };
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) root[find(sides[i].triangle)] = find(sides[i + 1].triangle);
  std::vector<int> number(root.size(), -1), part(root.size());
  int count = 0;
  for (std::size_t t = 0; t < root.size(); ++t) {
    int& of_root = number[find(static_cast<int>(t))];
    if (of_root < 0) of_root = count++;
    part[t] = of_root;
  }
  return part;
}

/// Six times the volume between a triangle and `origin`.
double six_volumes(const TriangleMesh& mesh, const Triangle& t, const Vector3d& origin) {
  return (mesh.points[t[0]] - origin).dot((mesh.points[t[1]] - origin).cross(mesh.points[t[2]] - origin));
}

double solid_angle(const TriangleMesh& mesh, const Triangle& t, const Vector3d& origin) {
  const Vector3d a = (mesh.points[t[0]] - origin).normalized(), b = (mesh.points[t[1]] - origin).normalized(),
                 c = (mesh.points[t[2]] - origin).normalized();
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Checks volumes: a part outside of all others has a positive volume, a cavity inside a part a negative one.
void check_outward(const TriangleMesh& mesh, const std::vector<int>& part, const std::string& name) {
  const int count = 1 + *std::ranges::max_element(part);
  constexpr int most_parts = 200;
  if (count > most_parts)
    throw ObstacleError(fmt::format("{}: the surface has {} parts, at most {} are allowed", name, count, most_parts));
  std::vector<double> volume(count, 0.0);
  std::vector<Vector3d> origin(count, Vector3d::Zero());
  for (std::size_t t = 0; t < part.size(); ++t) origin[part[t]] = mesh.points[mesh.triangles[t][0]];
  for (std::size_t t = 0; t < part.size(); ++t)
    volume[part[t]] += six_volumes(mesh, mesh.triangles[t], origin[part[t]]);
  for (int p = 0; p < count; ++p) {
    double around = 0;
    for (std::size_t t = 0; t < part.size() && count > 1; ++t)
      if (part[t] != p) around += solid_angle(mesh, mesh.triangles[t], origin[p]);
    const bool within = std::abs(around) > 2 * std::numbers::pi;
    if (within == (volume[p] > 0))
      throw ObstacleError(within
                              ? fmt::format("{}: the part at {} lies inside of another; a cavity must be turned inward",
                                            name, shown(origin[p]))
                              : fmt::format("{}: the surface is turned inward{}; turn its triangles around", name,
                                            count > 1 ? " at " + shown(origin[p]) : ""));
  }
}

}  // namespace

void check_closed(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) throw ObstacleError(fmt::format("{}: the surface has no triangles", name));
  check_areas(mesh, name);
  const auto sides = sorted_sides(mesh);
  check_sides(mesh, sides, name);
  check_outward(mesh, parts(mesh, sides), name);
}

}  // namespace plastron::obstacle
