// The answer is the end of a continuous path from the start (M36): no obstacle passes through the shell on it. The proof finds each
// obstacle that passes, and no other; a path that it refuses is taken in parts or named.
#include <plastron/certificate/crossings.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>
#include <plastron/obstacle/surface_mesh.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "computation/problems.hpp"

namespace plastron::computation::path_test {
namespace {

using namespace test;
using contact::Status;
using Eigen::Vector3d;
using obstacle::Obstacle;
using testing::HasSubstr;

constexpr double e = 0.02;

/// A strip in the plane z = 0, clamped at both ends, without load.
problem::Problem strip(double unit = 1, mesh::Shape cells = mesh::Shape::quadrilateral) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0"}, {});
  p.domain = domain::Rectangle{.to = {unit, 0.4 * unit}, .cells = {4, 2}};
  p.shell.sections.common.thickness = Expression(e * unit);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1 / (unit * unit), 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right")};
  p.shell.loads.on_areas.clear();
  p.shell.tying = cells == mesh::Shape::quadrilateral;
  p.discretisation = {.cells = cells, .degree = 2, .refinements = 0};
  return p;
}

obstacle::TriangleSurface box_of_triangles(const Vector3d& centre, double size) {
  obstacle::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.points.push_back(centre + size * Vector3d((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, (k >> 2) - 0.5));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return obstacle::TriangleSurface(mesh);
}

/// Bodies of about this size around a point, all of them within their size from it.
struct Body {
  const char* name;
  std::function<obstacle::Shape(const Vector3d& centre, double size)> shape;
};
const std::vector<Body> bodies{
    {"ball", [](const Vector3d& c, double s) { return obstacle::Ball{.centre = c, .radius = s}; }},
    {"cylinder",
     [](const Vector3d& c, double s) {
       return obstacle::Cylinder{.point = c, .axis = {0, 1, 0}, .radius = s};
     }},
    {"disk", [](const Vector3d& c, double s) { return obstacle::Cylinder{.point = c, .radius = s, .length = s}; }},
    {"box",
     [](const Vector3d& c, double s) {
       return obstacle::Box{.centre = c, .size = {s, 0.5 * s, 0.8 * s}};
     }},
    {"torus", [](const Vector3d& c,
                 double s) { return obstacle::Torus{.centre = c, .radius = 0.7 * s, .tube_radius = 0.2 * s}; }},
    {"cone",
     [](const Vector3d& c, double s) { return obstacle::Cone{.apex = c, .half_angle = 0.5, .height = 0.8 * s}; }},
    {"triangles", [](const Vector3d& c, double s) { return box_of_triangles(c, s); }},
};

/// The places where the obstacle may pass through the strip at rest on its whole motion.
std::vector<certificate::Crossing> crossings_of(const problem::Problem& p) {
  const FinestMesh mesh = finest_mesh(p, MPI_COMM_WORLD);
  const auto discrete = assembly::discretise(mesh.space, mesh.surface, p.shell);
  const auto steps = static_cast<double>(p.shell.obstacles.all.front().motions.size());
  return certificate::crossings(*discrete, {}, {.time = steps});
}

TEST(AnObstacle, ThatMovesThroughTheShellIsFoundAndOneThatStopsBeforeIsNot) {
  std::mt19937 random(7);
  const auto between = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  for (const Body& body : bodies)
    for (const double unit : {1e-6, 1.0, 1e6})
      for (const auto cells : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
        const double size = e * unit * std::exp(between(-2, 1.5)), side = between(0, 1) < 0.5 ? -1 : 1;
        const double away = e / 2 * unit + 1.01 * size;
        const Vector3d start(between(0.2, 0.8) * unit, between(0.15, 0.25) * unit,
                             side * (away + between(0, 0.1) * unit));
        SCOPED_TRACE(
            fmt::format("{} of size {} at ({}, {}, {}), unit {}", body.name, size, start[0], start[1], start[2], unit));
        problem::Problem p = strip(unit, cells);
        const auto moved_to = [&](double z) {
          p.shell.obstacles.all = {
              {.shape = body.shape(start, size), .motions = {{.translation = {0.01 * unit, 0, z - start[2]}}}}};
          return crossings_of(p);
        };
        EXPECT_FALSE(moved_to(-side * away).empty());
        EXPECT_TRUE(moved_to(side * away).empty());
      }
}

TEST(AnObstacle, ThatGoesAroundAnEdgeOfTheShellDoesNotPass) {
  problem::Problem p = strip();
  const double r = 0.03;
  p.shell.obstacles.all = {
      {.shape = obstacle::Ball{.centre = {0.5, 0.2, 0.1}, .radius = r},
       .motions = {{.translation = {0, 0.3, 0}}, {.translation = {0, 0, -0.2}}, {.translation = {0, -0.3, 0}}}}};
  EXPECT_TRUE(crossings_of(p).empty());
  // The same way turned about the edge.
  p.shell.obstacles.all[0].motions = {{.axis = {1, 0, 0}, .angle = -3, .about = {0.5, 0.4, 0}}};
  EXPECT_TRUE(crossings_of(p).empty());
  p.shell.obstacles.all[0].motions[0].angle = 3;  // the other way leads through the shell
  p.shell.obstacles.all[0].motions[0].about[1] = 0.25;
  EXPECT_FALSE(crossings_of(p).empty());
}

TEST(AnObstacle, ThatMovesThereAndBackPasses) {
  problem::Problem p = strip();
  p.shell.obstacles.all = {{.shape = obstacle::Ball{.centre = {0.5, 0.2, 0.1}, .radius = 0.03},
                            .motions = {{.translation = {0, 0, -0.2}}, {.translation = {0, 0, 0.2}}}}};
  EXPECT_FALSE(crossings_of(p).empty());
}

/// Results of the same scene where the obstacle comes from above: the force on the shell, upwards.
double upward(const Result& r) { return r.summary.reaction.force[2]; }

TEST(ABall, ThatMovesThroughTheShellInOnePartPressesFromItsSide) {
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const auto face : {obstacle::Face::nearer, obstacle::Face::upper})
      for (const double side : {1.0, -1.0}) {
        if (face == obstacle::Face::upper && side < 0) continue;
        SCOPED_TRACE(fmt::format("finite {}, upper {}, side {}", rotations == element::Rotations::finite,
                                 face == obstacle::Face::upper, side));
        problem::Problem p = strip();
        p.discretisation = {.degree = 3, .refinements = 1};
        p.shell.rotations = rotations;
        p.shell.obstacles.all = {{.shape = obstacle::Ball{.centre = {0.5, 0.2, 0.051 * side}, .radius = 0.04},
                                  .face = face,
                                  .motions = {{.translation = {0, 0, -0.06 * side}}}}};
        p.steps = {{.name = "in"}};
        const Result r = solve(p, MPI_COMM_WORLD);
        ASSERT_EQ(r.status, Status::solved) << status_text(r);
        EXPECT_LT(side * upward(r), 0);
      }
}

/// A thin body below the strip, past which a load would bend it.
Obstacle thin(bool is_wire) {
  if (is_wire)
    return {.name = "thin",
            .shape = obstacle::Cylinder{.point = {0.43, 0, -0.016}, .axis = {0, 1, 0}, .radius = 0.004}};
  return {.name = "thin", .shape = obstacle::Ball{.centre = {0.61, 0.17, -0.020}, .radius = 0.008}};
}

TEST(AThinObstacle, PastWhichALoadBendsTheShellIsNamedOrCarriesIt) {
  for (const bool is_wire : {true, false}) {
    SCOPED_TRACE(is_wire ? "wire" : "ball");
    problem::Problem p = strip();
    p.shell.loads.on_areas = {force(0, 0, -1.3e-5)};
    p.shell.obstacles.all = {thin(is_wire)};
    const Result coarse = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(coarse.status, Status::inaccurate);
    EXPECT_THAT(coarse.missed_limits, HasSubstr("the obstacle \"thin\" at x = "));
    const Verification v = verify(p, finest_mesh(p, MPI_COMM_WORLD),
                                  {.state = coarse.solution->discrete->state, .nodal = coarse.solution->nodal});
    EXPECT_THAT(v.result.missed_limits, HasSubstr("crossed_cells"));
    p.accuracy = problem::Accuracy{.goals = {{"energy", 0.05}}, .max_unknowns = 2e4};
    p.discretisation.degree = 4;
    const Result fine = solve(p, MPI_COMM_WORLD);
    if (fine.status == Status::solved) {
      EXPECT_GT(upward(fine), 0);
    }
  }
}

}  // namespace
}  // namespace plastron::computation::path_test
