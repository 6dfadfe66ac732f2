// Checks that no edges of the domain coincide in space without being joined: a slit. Example: the two edges of a sheet
// that the chart rolls to a tube. Sides of cells are compared as a whole.
#include <plastron/examination/checks.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace plastron::examination {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A side of a cell on the boundary of the domain: its two ends and its middle in space.
struct OuterSide {
  Vector3d from, middle, to;
  Vector2d x;                ///< parameters of the middle
  std::set<int> boundaries;  ///< -1 alone: without name
  double length() const { return (to - middle).norm() + (middle - from).norm(); }
};

std::pair<algebra::LocalIndex, algebra::LocalIndex> ends_of(const fem::Space& space, std::size_t cell, int side) {
  const auto on_side = mesh::side_nodes(space.shape(), space.degree, side);
  const auto nodes = space.nodes(cell);
  return std::minmax(nodes[static_cast<std::size_t>(on_side.front())], nodes[static_cast<std::size_t>(on_side.back())]);
}

OuterSide outer_side(const fem::Space& space, const fem::Surface& surface, const fem::BoundarySide& edge) {
  std::vector<Vector2d> xi;
  for (const double t : {0.0, 0.5, 1.0}) xi.push_back(mesh::side_point(space.shape(), edge.side, t));
  std::array<geometry::Frame, 3> frames;
  std::array<double, 3> x{}, y{};
  surface.frames(space.cells[edge.cell], xi, frames, false);
  surface.positions(space.cells[edge.cell], xi, x, y);
  return {frames[0].phi, frames[1].phi, frames[2].phi, {x[1], y[1]}, {}};
}

/// Returns outer sides. Named sides inside the domain belong to two cells and are ignored.
std::vector<OuterSide> outer_sides(const fem::Space& space, const fem::Surface& surface) {
  std::map<std::pair<algebra::LocalIndex, algebra::LocalIndex>, int> cells_at;
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    for (int side = 0; side < mesh::corner_count(space.shape()); ++side) ++cells_at[ends_of(space, c, side)];
  std::vector<OuterSide> sides;
  std::map<std::pair<std::size_t, int>, std::size_t> known;
  for (const fem::BoundarySide& edge : space.sides) {
    if (edge.is_inner || cells_at[ends_of(space, edge.cell, edge.side)] != 1) continue;
    const auto [at, is_new] = known.emplace(std::pair(edge.cell, edge.side), sides.size());
    if (is_new) sides.push_back(outer_side(space, surface, edge));
    sides[at->second].boundaries.insert(edge.boundary);
  }
  return sides;
}

bool coincide(const OuterSide& a, const OuterSide& b) {
  const double tolerance = 1e-6 * a.length();
  const auto near = [&](const Vector3d& p, const Vector3d& q) { return (p - q).norm() <= tolerance; };
  return near(a.middle, b.middle) &&
         ((near(a.from, b.from) && near(a.to, b.to)) || (near(a.from, b.to) && near(a.to, b.from)));
}

std::string names_of(const OuterSide& side, const std::vector<std::string>& names) {
  std::string text;
  for (const int boundary : side.boundaries)
    text += fmt::format(
        "{}{}", text.empty() ? "" : " and ",
        boundary < 0 ? "an unnamed boundary" : fmt::format("\"{}\"", names[static_cast<std::size_t>(boundary)]));
  return text;
}

void add_seam(Examined& examined, const OuterSide& a, const OuterSide& b) {
  const auto& names = examined.space->coarse->boundaries;
  examined.add(Severity::warning,
               "the boundary of the domain meets itself in space but is not joined there: {} at {} and {} at {} are "
               "the same place, ({:.6g}, {:.6g}, {:.6g}); the shell is slit along this seam and "
               "may open: support both sides alike (by symmetry, say), or mesh the domain in one piece",
               names_of(a, names), examined.place(a.x), names_of(b, names), examined.place(b.x), a.middle[0],
               a.middle[1], a.middle[2]);
}

}  // namespace

void check_seams(Examined& examined) {
  std::vector<OuterSide> sides = outer_sides(*examined.space, *examined.surface);
  // Nothing is aligned with this direction, so equal places are neighbours along it.
  const Vector3d direction(0.6123, 0.5477, 0.5701);
  std::ranges::sort(sides, {}, [&](const OuterSide& s) { return direction.dot(s.middle); });
  std::set<std::pair<std::set<int>, std::set<int>>> told;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      if (direction.dot(sides[j].middle - sides[i].middle) > 1e-6 * sides[i].length()) break;
      if (!coincide(sides[i], sides[j])) continue;
      const bool in_order = sides[i].boundaries <= sides[j].boundaries;
      const OuterSide &a = sides[in_order ? i : j], &b = sides[in_order ? j : i];
      if (told.emplace(a.boundaries, b.boundaries).second) add_seam(examined, a, b);
    }
}

}  // namespace plastron::examination
