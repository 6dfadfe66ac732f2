// Lines joined from segments in a drawn order and sense: they are the curves from which the segments were cut, and their order does not
// depend on that of the segments. Areas of half planes are those of polygons.
#include <gtest/gtest.h>
#include <plastron/zones/boundary_segments.hpp>
#include <plastron/zones/contact_zones.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "assembly/sample_shells.hpp"

namespace plastron::zones::contact_lines_test {
namespace {

using Random = std::mt19937;
using Places = std::vector<Vector3d>;

double drawn(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

/// A polyline cut in segments. Its points lie between the nodes `first`, `first` + 1, ... and those after them.
void cut(const Places& points, bool is_closed, bool is_rim, algebra::GlobalIndex first,
         std::vector<Segment>& segments) {
  const auto end_at = [&](std::size_t i) {
    const algebra::GlobalIndex node = first + 2 * static_cast<algebra::GlobalIndex>(i % points.size());
    return SegmentEnd{.nodes = {node, node + 1},
                      .names = {node, node + 1},
                      .point = {.x = points[i % points.size()].head<2>(), .place = points[i % points.size()]}};
  };
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < points.size(); ++i)
    segments.push_back({.zone = 0, .is_rim = is_rim, .ends = {end_at(i), end_at(i + 1)}});
}

double length_of(const Places& points, bool is_closed) {
  double sum = is_closed ? (points.front() - points.back()).norm() : 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

Places ring(const Vector3d& centre, double radius, int points) {
  Places places;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / points;
    places.push_back(centre + radius * Vector3d(std::cos(angle), std::sin(angle), 0.1 * std::cos(2 * angle)));
  }
  return places;
}
Places path(const Vector3d& from, const Vector3d& way, int points) {
  Places places;
  for (int i = 0; i < points; ++i) places.push_back(from + i * way + Vector3d(0, 0, std::sin(3.0 * i) / 10));
  return places;
}

void shuffle(std::vector<Segment>& segments, Random& random) {
  std::ranges::shuffle(segments, random);
  for (Segment& segment : segments)
    if (drawn(random, 0, 1) < 0.5) std::swap(segment.ends[0], segment.ends[1]);
}

/// Whether the points of a line are those of a polyline, in one sense or the other, from any point of a closed one.
bool is_along(const solution::ContactLine& line, Places points, bool is_closed) {
  Places found;
  for (const solution::BoundaryPoint& p : line.points) found.push_back(p.place);
  if (is_closed) {
    if (found.front() != found.back()) return false;
    found.pop_back();
  }
  if (found.size() != points.size()) return false;
  for (int sense = 0; sense < 2; ++sense) {
    for (std::size_t k = 0; k < (is_closed ? points.size() : 1); ++k) {
      if (found == points) return true;
      std::rotate(points.begin(), points.begin() + 1, points.end());
    }
    if (!is_closed) std::rotate(points.begin(), points.end() - 1, points.end());
    std::ranges::reverse(points);
  }
  return false;
}

TEST(ContactLines, AreTheCurvesFromWhichSegmentsWereCutInOneOrder) {
  struct Curve {
    Places points;
    bool is_closed, is_rim;
  };
  // Inside long before short, then the rim likewise.
  const std::vector<Curve> curves{{ring({0, 0, 0}, 2, 23), true, false},
                                  {path({-3, 1, 0}, {0.3, 0.1, 0}, 12), false, false},
                                  {ring({0.2, 0.1, 0}, 0.5, 7), true, false},
                                  {path({-3, -3, 0}, {0.7, 0, 0}, 9), false, true},
                                  {ring({5, 5, 0}, 0.3, 4), true, true}};
  std::vector<Segment> segments;
  algebra::GlobalIndex first = 0;
  for (const Curve& curve : curves) {
    cut(curve.points, curve.is_closed, curve.is_rim, first, segments);
    first += 100;
  }
  Random random(1);
  std::vector<solution::ContactLine> before;
  for (int draw = 0; draw < 50; ++draw) {
    shuffle(segments, random);
    const auto lines = contact_lines(segments, 10);
    ASSERT_EQ(lines.size(), curves.size());
    for (std::size_t k = 0; k < curves.size(); ++k) {
      EXPECT_EQ(lines[k].is_closed, curves[k].is_closed);
      EXPECT_EQ(lines[k].is_rim, curves[k].is_rim);
      EXPECT_NEAR(lines[k].length, length_of(curves[k].points, curves[k].is_closed), 1e-12);
      EXPECT_TRUE(is_along(lines[k], curves[k].points, curves[k].is_closed)) << "curve " << k;
      if (draw == 0) continue;
      ASSERT_EQ(lines[k].points.size(), before[k].points.size());
      for (std::size_t i = 0; i < lines[k].points.size(); ++i)
        EXPECT_EQ(lines[k].points[i].place, before[k].points[i].place);
    }
    before = lines;
  }
}

// Cells on both sides of a side with hanging nodes end one line at different points, nearer to each other than their reach.
TEST(ContactLines, GoOnAcrossHangingNodesWithinTheirReach) {
  Random random(2);
  for (const double gap : {0.0, 0.05, 0.19, 0.21, 0.5}) {
    std::vector<Segment> segments;
    const Places left = path({-2, 0, 0}, {0.25, 0, 0}, 9);
    Places right = path({0, 0, 0}, {0.25, 0, 0}, 9);
    for (Vector3d& place : right) place += left.back() - right.front() + Vector3d(0, gap, 0);
    cut(left, false, false, 0, segments);
    cut(right, false, false, 100, segments);
    segments[7].ends[1].reach = segments[8].ends[0].reach = 0.2;  // the last end on the left, the first on the right
    for (int draw = 0; draw < 10; ++draw) {
      auto drawn_segments = segments;
      shuffle(drawn_segments, random);
      const auto lines = contact_lines(drawn_segments, 4);
      ASSERT_EQ(lines.size(), gap < 0.2 ? 1U : 2U) << gap;
      double length = 0;
      for (const solution::ContactLine& line : lines) {
        length += line.length;
        EXPECT_FALSE(line.is_closed);
      }
      EXPECT_NEAR(length, length_of(left, false) + length_of(right, false), 1e-12);
    }
  }
}

/// A flat plate on a table that touches it where s = n . x - c is negative. Outside the gap opens as beside a straight edge.
std::vector<double> areas_of_half_plane(mesh::Shape shape, int degree, const Eigen::Vector2d& n, double c) {
  constexpr double thickness = 0.1;
  const auto m = test::meshed(domain::Rectangle{.to = {2, 1}, .cells = {12, 6}}, test::flat, degree, 0, shape);
  const auto discrete =
      assembly::discretise(m.space, m.surface,
                           {.sections = test::steel_of(geometry::Expression(thickness)),
                            .obstacles = {.all = {{.name = "table", .face = obstacle::Face::lower}}}});
  solution::NodalSolution nodal{.y = algebra::Vector(m.space->layout, 6),
                                .pressure = algebra::Vector(m.space->layout, 1),
                                .touching = algebra::Vector(m.space->layout, 1)};
  const double delta = shell::bending_length(
      shell::section_at(test::steel_like(), shell::orthonormal_frame(Vector3d::UnitX(), Vector3d::UnitY()), thickness));
  for (std::size_t i = 0; i < discrete->points.size(); ++i) {
    const assembly::NodalPoint& p = discrete->points[i];
    const double s = n.dot(p.x) - c, t = std::max(s, 0.0);
    nodal.y.local()[6 * i + 2] = 0.7 * t * t * (3 * delta + t) - discrete->coordinates.gaps[0][i].initial;
    if (s <= 0 && p.weight > 0) nodal.touching.local()[i] = 1;
  }
  return contact_areas(*discrete, nodal);
}

/// The area of the part of the rectangle (0, 2) x (0, 1) where n . x < c.
double clipped_area(const Eigen::Vector2d& n, double c) {
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  std::vector<Eigen::Vector2d> inside;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % 4];
    const double from = n.dot(a) - c, to = n.dot(b) - c;
    if (from < 0) inside.push_back(a);
    if ((from < 0) != (to < 0)) inside.emplace_back(a + from / (from - to) * (b - a));
  }
  double twice = 0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const Eigen::Vector2d &a = inside[i], &b = inside[(i + 1) % inside.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// Where the edge makes an acute wedge with the rim, a free node in the tip may count as touching: a part of one cell.
TEST(ContactAreas, OfHalfPlanesAreThoseOfPolygons) {
  constexpr double degrees = std::numbers::pi / 180, cell = 1.0 / 36;
  Random random(3);
  for (const auto& [shape, degree] :
       {std::pair{test::quadrilateral, 1}, std::pair{test::quadrilateral, 2}, std::pair{test::quadrilateral, 3},
        std::pair{test::triangle, 1}, std::pair{test::triangle, 2}})
    for (int draw = 0; draw < 16; ++draw) {
      const bool is_acute = draw >= 12;
      const double angle = 90 * degrees * draw + degrees * (is_acute ? drawn(random, 5, 25) : drawn(random, 30, 60));
      const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
      const double c = n.dot(Eigen::Vector2d(drawn(random, 0.5, 1.5), drawn(random, 0.25, 0.75)));
      const bool has_bounds = shape == test::quadrilateral || degree == 1;  // at all nodes
      const std::vector<double> areas = areas_of_half_plane(shape, degree, n, c);
      ASSERT_EQ(areas.size(), 1U);
      EXPECT_NEAR(areas[0], clipped_area(n, c),
                  is_acute     ? cell / 3
                  : has_bounds ? 1e-9
                               : 1e-6)
          << mesh::corner_count(shape) << " corners, degree " << degree << ", angle " << angle << ", " << c;
    }
}

}  // namespace
}  // namespace plastron::zones::contact_lines_test
