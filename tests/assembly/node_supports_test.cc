// Supports where boundaries meet: corners, smooth meetings, values that differ by rounding, and contradictions.
#include "assembly/sample_shells.hpp"

#include <gtest/gtest.h>
#include <plastron/domain/domain.hpp>

#include <cmath>

namespace plastron::assembly {
namespace {

/// Two cells side by side above y = 0. Their lower sides meet at (1, 0) times scale, where the boundary turns left by
/// `angle`. The first side is called "a", the second "a" or "b".
test::MeshedSurface bent(double angle, const std::string& second, double scale = 1) {
  mesh::CoarseMesh mesh;
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), {1.0, 0.0}, {1 + std::cos(angle), std::sin(angle)}, {0.0, 1.0}, {1.0, 1.0}, {2.0, 1.5}})
    mesh.vertices.emplace_back(scale * x, scale * y);
  for (const auto& v : {std::array{0, 1, 3, 4}, std::array{1, 2, 4, 5}}) {
    std::vector<Eigen::Vector2d> nodes;
    for (const int k : v) nodes.push_back(mesh.vertices[static_cast<std::size_t>(k)]);
    mesh.cells.push_back({v, 0, {mesh::LagrangeMap{1, nodes}}});
  }
  mesh.regions = {""};
  mesh.boundaries = {"a", "b", "top", "left"};
  mesh.edges = {{{0, 1}, 0}, {{1, 2}, second == "a" ? 0 : 1}, {{3, 4}, 2}, {{4, 5}, 2}, {{0, 3}, 3}};
  fem::MeshSequence meshes(std::move(mesh), 2, MPI_COMM_WORLD);
  meshes.refine({});
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart({"x", "y", "0"}, {}));
  return {meshes.space(), std::make_shared<const fem::Surface>(meshes.space()->coarse, charts)};
}

Support held(const std::string& boundary, Direction direction, const geometry::Expression& value = {}) {
  return {.boundary = boundary, .components = {{Unknown::displacement, direction, value}}};
}

std::unique_ptr<DiscreteShell> shell_of(const test::MeshedSurface& m, const std::vector<Support>& supports) {
  return discretise(m.space, m.surface, {.sections = test::steel_of(geometry::Expression(0.1)), .supports = supports});
}

struct Prescribed {
  double components = 0;  ///< number of prescribed coordinates at the point
  double largest = 0;     ///< of their values
};

/// At the node nearest to x, on any rank.
Prescribed prescribed_at(const test::MeshedSurface& m, const std::vector<Support>& supports, const Eigen::Vector2d& x) {
  const auto discrete = shell_of(m, supports);
  const auto& c = discrete->coordinates;
  Prescribed result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.space->layout->owned); ++i) {
    if ((discrete->points[i].x - x).norm() > 1e-3 * x.norm()) continue;
    for (int k = 0; k < c.width; ++k)
      if (c.is_prescribed(i, k)) {
        ++result.components;
        result.largest = std::max(result.largest, std::abs(c.lower.local()[c.at(i, k)]));
      }
  }
  return {algebra::sum_over_ranks(result.components, MPI_COMM_WORLD),
          algebra::max_over_ranks(result.largest, MPI_COMM_WORLD)};
}

constexpr double degree = 3.14159265358979323846 / 180;

TEST(Corner, OfAFewDegreesInOneBoundaryHasTwoConormalsAsWithTwoNames) {
  const std::vector<Support> one{held("a", Direction::conormal)};
  const std::vector<Support> two{held("a", Direction::conormal), held("b", Direction::conormal)};
  for (const double angle : {2.0, 20.0, 25.0, 60.0, -20.0})
    for (const bool in_one : {true, false}) {
      const auto m = bent(angle * degree, in_one ? "a" : "b");
      const auto& supports = in_one ? one : two;
      EXPECT_EQ(prescribed_at(m, supports, {1, 0}).components, 2) << angle << in_one;
      EXPECT_EQ(prescribed_at(m, supports, {0.5, 0}).components, 1) << angle << in_one;
    }
}

TEST(Corner, OfLessThanADegreeIsASmoothCurve) {
  EXPECT_EQ(prescribed_at(bent(0.5 * degree, "a"), {held("a", Direction::conormal)}, {1, 0}).components, 1);
}

// The difference of the two values is rounding. Divided by that of the conormals it would move the node along the curve.
TEST(BoundariesThatMeetSmoothly, PrescribeTheirConormalOnce) {
  const geometry::Expression one(1e-3), other(1e-3 + 1e-13);
  for (const double angle : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5})
    for (const double scale : {1e-6, 1.0, 1e6}) {
      const auto at =
          prescribed_at(bent(angle, "b", scale),
                        {held("a", Direction::conormal, one), held("b", Direction::conormal, other)}, {scale, 0});
      EXPECT_EQ(at.components, 1) << angle << " " << scale;
      EXPECT_NEAR(at.largest, 1e-3, 1e-9) << angle << " " << scale;
    }
}

/// The unit square times scale.
test::MeshedSurface square(double scale) {
  return test::meshed(domain::Rectangle{.to = {scale, scale}, .cells = {2, 2}}, {"x", "y", "0"}, 2, 1);
}

geometry::Expression sine(double amplitude, double scale) {
  return {"A*sin(pi*x/L)", {{"A", amplitude}, {"L", scale}}};
}

TEST(SupportValues, EqualToRoundingDoNotContradict) {
  for (const double scale : {1e-12, 1e-6, 1.0, 1e6})
    for (const double amplitude : {1e-3 * scale, 1e-9 * scale}) {
      const auto m = square(scale);
      const auto value = sine(amplitude, scale);
      EXPECT_NO_THROW(shell_of(m, {held("bottom", Direction::z, value), held("right", Direction::z)}));
      EXPECT_NO_THROW(shell_of(m, {held("right", Direction::z), held("bottom", Direction::z, value)}));
      // All values of one support are rounding.
      EXPECT_NO_THROW(shell_of(m, {held("right", Direction::z, value), held("top", Direction::z)}));
    }
}

// On every rank alike, also on those that do not own the corner.
TEST(SupportValues, ThatContradictAreRefusedOnEveryRankAndInEveryUnit) {
  for (const double scale : {1e-12, 1e-6, 1.0, 1e6})
    for (const double factor : {1e-3, 1e-9}) {
      const auto m = square(scale);
      const geometry::Expression one(factor * scale), two(1.001 * factor * scale);
      for (const char* corner : {"left", "right"}) {
        EXPECT_THROW(shell_of(m, {held("bottom", Direction::z, one), held(corner, Direction::z, two)}), SupportError);
        EXPECT_THROW(shell_of(m, {held("bottom", Direction::z, one), held(corner, Direction::z)}), SupportError);
      }
    }
}

}  // namespace
}  // namespace plastron::assembly
