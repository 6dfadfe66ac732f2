#include <plastron/facets/repair.hpp>

#include <plastron/geometry/file_error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace plastron::facets {

namespace {

using Triangle = std::array<int, 3>;
using geometry::TriangleSide, geometry::sorted_sides;

std::string shown(const Vector3d& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

void keep_triangles(const std::vector<bool>& is_kept, TriangleMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_kept[t]) continue;
    mesh.triangles[kept] = mesh.triangles[t];
    if (!mesh.group_of.empty()) mesh.group_of[kept] = mesh.group_of[t];
    ++kept;
  }
  mesh.triangles.resize(kept);
  if (!mesh.group_of.empty()) mesh.group_of.resize(kept);
}

/// Makes one point of the ends of sides that are a millionth of the longest side of their triangle, and removes the
/// triangles that lose a side. Returns their number.
std::size_t remove_needles(TriangleMesh& mesh) {
  constexpr double short_side = 1e-6;
  const std::size_t before = mesh.triangles.size();
  for (bool is_found = true; is_found;) {
    std::map<int, int> instead;
    std::set<int> kept;
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
        const Vector3d &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[t[(k + 2) % 3]];
        if ((p - q).norm() > short_side * (p - r).norm()) continue;
        if (instead.contains(a) || instead.contains(b) || kept.contains(b)) continue;
        instead[b] = a;
        kept.insert(a);
      }
    std::vector<bool> is_kept;
    for (Triangle& t : mesh.triangles) {
      for (int& corner : t)
        if (const auto found = instead.find(corner); found != instead.end()) corner = found->second;
      is_kept.push_back(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    keep_triangles(is_kept, mesh);
    is_found = !instead.empty();
  }
  return before - mesh.triangles.size();
}

/// Returns k so that the side from corner k to the next one is the longest, if the triangle has no area; else -1.
int flat_side(const TriangleMesh& mesh, const Triangle& triangle) {
  constexpr double least_sine = 1e-6;
  std::array<double, 3> length;
  for (std::size_t k = 0; k < 3; ++k)
    length[k] = (mesh.points[triangle[(k + 1) % 3]] - mesh.points[triangle[k]]).squaredNorm();
  const auto longest = std::ranges::max_element(length);
  if (normal_of(mesh, triangle).norm() > least_sine * *longest) return -1;
  return static_cast<int>(longest - length.begin());
}

/// Gives a flat triangle abc, whose c lies on its side ab, to the triangle bad beyond that side: they become acd and cbd,
/// turned as bad. Returns false if that is no surface.
bool give_away(std::size_t flat, int side, std::size_t beyond, TriangleMesh& mesh) {
  const Triangle t = mesh.triangles[flat], neighbour = mesh.triangles[beyond];
  const int a = t[side], b = t[(side + 1) % 3], c = t[(side + 2) % 3];
  if (std::ranges::count(neighbour, c) > 0) return false;
  const auto with = [&](int corner, int instead) {
    Triangle changed = neighbour;
    std::ranges::replace(changed, corner, instead);
    return changed;
  };
  mesh.triangles[flat] = with(b, c);
  mesh.triangles[beyond] = with(a, c);
  if (!mesh.group_of.empty()) mesh.group_of[flat] = mesh.group_of[beyond];
  return true;
}

[[noreturn]] void refuse_flat(const TriangleMesh& mesh, std::size_t triangle, const std::string& name) {
  throw geometry::FileError(fmt::format(
      "{}: the triangle at {} has no area; allowed are triangles with an area, and flat ones beside one that "
      "can take their place; repair the surface (MeshLab: Remove T-Vertices)",
      name, shown(mesh.points[mesh.triangles[triangle][0]])));
}

/// Neighbours of each triangle, and whether they traverse the common side alike, so that one of them must be turned.
std::vector<std::vector<std::pair<int, bool>>> neighbours_of(const TriangleMesh& mesh, const Sides& sides) {
  std::vector<std::vector<std::pair<int, bool>>> neighbours(mesh.triangles.size());
  for (const auto& [begin, end] : sides.ranges) {
    if (end - begin != 2) continue;
    const TriangleSide &s = sides.all[begin], &o = sides.all[begin + 1];
    neighbours[std::size_t(s.triangle)].emplace_back(o.triangle, s.rises == o.rises);
    neighbours[std::size_t(o.triangle)].emplace_back(s.triangle, s.rises == o.rises);
  }
  return neighbours;
}

}  // namespace

Sides::Sides(const TriangleMesh& mesh) : all(sorted_sides(mesh)) {
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].is_same(all[i])) ++end;
    ranges.push_back({i, end});
  }
}

std::size_t remove_repeated(TriangleMesh& mesh) {
  std::set<Triangle> known;
  std::vector<bool> is_kept;
  for (Triangle corners : mesh.triangles) {
    std::ranges::sort(corners);
    is_kept.push_back(known.insert(corners).second);
  }
  keep_triangles(is_kept, mesh);
  return is_kept.size() - mesh.triangles.size();
}

std::size_t remove_flat(TriangleMesh& mesh, const std::string& name) {
  // In several passes, each of which changes every triangle at most once.
  constexpr int most_passes = 100;
  std::size_t count = remove_needles(mesh);
  const auto is_flat = [&](const Triangle& triangle) { return flat_side(mesh, triangle) >= 0; };
  for (int pass = 0;; ++pass) {
    if (std::ranges::none_of(mesh.triangles, is_flat)) return count;
    std::map<std::array<int, 2>, std::vector<std::size_t>> at_side;
    for (const TriangleSide& s : sorted_sides(mesh)) at_side[{s.low, s.high}].push_back(std::size_t(s.triangle));
    std::vector<bool> is_kept(mesh.triangles.size(), true), is_changed(mesh.triangles.size(), false);
    for (std::size_t t = 0; t < is_kept.size(); ++t) {
      const int side = is_changed[t] ? -1 : flat_side(mesh, mesh.triangles[t]);
      if (side < 0) continue;
      const auto [a, b] = std::minmax(mesh.triangles[t][side], mesh.triangles[t][(side + 1) % 3]);
      const auto& both = at_side.at({a, b});
      if (std::ranges::any_of(both, [&](std::size_t other) { return is_changed[other]; })) continue;
      for (const std::size_t other : both) is_changed[other] = true;
      ++count;
      if (both.size() == 1)
        is_kept[t] = false;  // its other sides become the border
      else if (both.size() > 2 || pass == most_passes || !give_away(t, side, both[both[0] == t ? 1 : 0], mesh))
        refuse_flat(mesh, t, name);
    }
    keep_triangles(is_kept, mesh);
  }
}

void check_sides(const TriangleMesh& mesh, const Sides& sides, const std::string& name) {
  std::size_t count = 0, first = 0, most = 0;
  for (const auto& [begin, end] : sides.ranges) {
    if (end - begin <= 2) continue;
    if (count++ == 0) first = begin;
    most = std::max(most, end - begin);
  }
  if (count == 0) return;
  throw geometry::FileError(fmt::format(
      "{}: up to {} triangles meet at {}, the first from {} to {}; the facets of a shell have one or two "
      "triangles at a side; for a part with branches, like ribs, mesh the CAD part by Gmsh and give the .msh file",
      name, most, count == 1 ? "1 side" : fmt::format("{} sides", count), shown(mesh.points[sides.all[first].low]),
      shown(mesh.points[sides.all[first].high])));
}

std::size_t turn_alike(TriangleMesh& mesh, const Sides& sides, const std::string& name) {
  const auto neighbours = neighbours_of(mesh, sides);
  std::vector<int> sign(mesh.triangles.size(), 0);
  for (std::size_t seed = 0; seed < sign.size(); ++seed) {
    if (sign[seed] != 0) continue;
    std::vector<std::size_t> part{seed};
    sign[seed] = 1;
    double area = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::size_t t = part[i];
      area += sign[t] * normal_of(mesh, mesh.triangles[t]).norm();
      for (const auto& [other, is_opposite] : neighbours[t]) {
        const int wanted = is_opposite ? -sign[t] : sign[t];
        int& given = sign[std::size_t(other)];
        if (given == -wanted)
          throw geometry::FileError(
              fmt::format("{}: the surface has one side only, like a Moebius strip, first noticed at {}; a "
                          "shell has two sides; cut the surface",
                          name, shown(mesh.points[mesh.triangles[t][0]])));
        if (given == 0) part.push_back(std::size_t(other));
        given = wanted;
      }
    }
    if (area < 0)
      for (const std::size_t t : part) sign[t] = -sign[t];
  }
  std::size_t turned = 0;
  for (std::size_t t = 0; t < sign.size(); ++t)
    if (sign[t] < 0) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]), ++turned;
  return turned;
}

}  // namespace plastron::facets
