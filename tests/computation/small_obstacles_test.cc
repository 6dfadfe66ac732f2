// Obstacles that are thinner than the shell, smaller than a cell, or faster than their own thickness in a step. The shell meets them
// from the side that they come from, or the result is not called solved.
#include <plastron/computation/solve.hpp>
#include <plastron/computation/verify.hpp>
#include <plastron/obstacle/surface_mesh.hpp>
#include <plastron/problem/instants.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "computation/problems.hpp"

namespace plastron::computation::small_obstacles_test {
namespace {

using namespace test;
using contact::Status;
using obstacle::Obstacle;
using testing::HasSubstr;

constexpr double e = 0.05;

/// A strip along x in the plane z = 0, clamped at both ends, in plane strain, without load.
problem::Problem strip(double length = 1, double modulus = 1) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "0"}, {});
  p.domain = domain::Rectangle{.to = {length, 0.125 * length}, .cells = {8, 1}};
  p.shell.sections.common.thickness = Expression(e * length);
  p.shell.sections.common.material = shell::Material::from_young_poisson(modulus, 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right"), in_plane("bottom"), in_plane("top")};
  p.shell.loads.on_areas.clear();
  p.discretisation = {.degree = 2, .refinements = 1};
  return p;
}

/// A body whose top is `depth` inside the strip's lower face at x = `at`; its lowest point is `height` below.
Obstacle wire(double radius, double depth, double at = 0.5) {
  return {.name = "wire",
          .shape = obstacle::Cylinder{.point = {at, 0, -e / 2 + depth - radius}, .axis = {0, 1, 0}, .radius = radius}};
}
Obstacle box(double width, double height, double depth) {
  return {.name = "box",
          .shape = obstacle::Box{.centre = {0.5, 0.0625, -e / 2 + depth - height / 2}, .size = {width, 1, height}}};
}

Result solved(problem::Problem p, const Obstacle& obstacle) {
  p.shell.obstacles.all = {obstacle};
  return solve(p, MPI_COMM_WORLD);
}

/// The force of the obstacle, upwards [N].
double upward(const Result& r) { return r.summary.reaction.force[2]; }

/// Along a line, a hump has the same contact with a thick roller as with a wire.
void expect_like_a_roller(const Result& r, double depth) {
  const Result roller = solved(strip(), wire(0.2, depth));
  ASSERT_EQ(r.status, Status::solved) << status_text(r);
  EXPECT_GT(upward(r), 0);
  EXPECT_NEAR(upward(r) / upward(roller), 1, 2e-2);
  EXPECT_NEAR(r.summary.energy.total() / roller.summary.energy.total(), 1, 2e-2);
}

TEST(AWire, ThinnerThanTheShellIsMetFromBelow) {
  for (const double radius : {0.02, 0.01, 0.004})  // the last one lies wholly inside the undeformed shell
    for (const double depth : {0.004, 0.015}) {
      SCOPED_TRACE(fmt::format("radius {}, depth {}", radius, depth));
      expect_like_a_roller(solved(strip(), wire(radius, depth)), depth);
    }
}

TEST(AThinBox, DoesNotPushNodesOutOfItsFarSide) {
  expect_like_a_roller(solved(strip(), box(0.02, 0.008, 0.015)), 0.015);
}

TEST(ABlade, NarrowerThanTheShellIsMetAtItsTip) { expect_like_a_roller(solved(strip(), box(0.02, 0.2, 0.015)), 0.015); }

/// Its nodes are closer together than the blade is wide. For nodes near a wall the shortest way out leads through that wall.
problem::Problem fine_strip() {
  problem::Problem p = strip();
  p.domain = domain::Rectangle{.to = {1, 0.125}, .cells = {32, 1}};
  return p;
}

TEST(ABlade, LiftsAllNodesOverItsTipInProportionToItsDepth) {
  const Result once = solved(fine_strip(), box(0.06, 0.5, 0.02)), twice = solved(fine_strip(), box(0.06, 0.5, 0.04));
  for (const Result* r : {&once, &twice}) ASSERT_EQ(r->status, Status::solved) << status_text(*r);
  EXPECT_NEAR(upward(twice) / upward(once), 2, 1e-3);
  EXPECT_LT(twice.summary.reaction.force.head<2>().norm(), 1e-6 * upward(twice));
}

TEST(ABlade, MuchDeeperThanTheShellIsThickIsNotCalledSolved) {
  const Result r = solved(fine_strip(), box(0.06, 0.5, 0.12));
  EXPECT_NE(r.status, Status::solved);
  EXPECT_THAT(r.warnings, testing::Contains(HasSubstr("\"box\"")));
}

TEST(AWire, FromAboveIsTheMirrorImage) {
  Obstacle above = wire(0.01, 0.015);
  std::get<obstacle::Cylinder>(above.shape).point[2] *= -1;
  const Result low = solved(strip(), wire(0.01, 0.015)), high = solved(strip(), above);
  ASSERT_EQ(high.status, Status::solved) << status_text(high);
  EXPECT_NEAR(upward(high) / upward(low), -1, 1e-9);
  above.face = obstacle::Face::upper;
  EXPECT_NEAR(upward(solved(strip(), above)) / upward(low), -1, 1e-9);
}

TEST(AWire, IsMetOnTrianglesToo) {
  problem::Problem p = strip();
  p.discretisation.cells = mesh::Shape::triangle;
  p.shell.tying = false;
  const Result r = solved(p, wire(0.01, 0.015)), thick = solved(p, wire(0.2, 0.015));
  ASSERT_EQ(r.status, Status::solved) << status_text(r);
  EXPECT_NEAR(upward(r) / upward(thick), 1, 2e-2);
}

TEST(AWire, IsMetInAnyUnits) {
  const Result metres = solved(strip(), wire(0.01, 0.015));
  for (const double unit : {1e-6, 1e6}) {
    Obstacle scaled = wire(0.01, 0.015);
    auto& body = std::get<obstacle::Cylinder>(scaled.shape);
    body.point *= unit;
    body.radius *= unit;
    const Result r = solved(strip(unit, 1 / (unit * unit)), scaled);
    ASSERT_EQ(r.status, Status::solved) << status_text(r);
    EXPECT_NEAR(upward(r) / upward(metres), 1, 1e-6);
  }
}

TEST(AWire, IsMetByACurvedShellThatIsTurnedInSpace) {
  // A quarter of a tube with its axis along y, and the same turned by 90 degrees about x.
  const auto tube = [](bool is_turned) {
    problem::Problem p = strip();
    const std::string x = "R*sin(x)", y = "y", z = "R*cos(x) - R";
    p = with_chart(p,
                   is_turned ? std::array<std::string, 3>{x, "R - R*cos(x)", y} : std::array<std::string, 3>{x, y, z},
                   {{"R", 1}});
    p.domain = domain::Rectangle{.from = {-0.5, 0}, .to = {0.5, 0.125}, .cells = {8, 1}};
    p.shell.supports = {clamped("left"), clamped("right")};
    p.discretisation.refinements = 1;
    return p;
  };
  const auto under = [](bool is_turned, double radius) {
    const double z = -e / 2 + 0.012 - radius;
    const Eigen::Vector3d point = is_turned ? Eigen::Vector3d(0, -z, 0) : Eigen::Vector3d(0, 0, z);
    const Eigen::Vector3d axis = is_turned ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
    return Obstacle{.name = "wire", .shape = obstacle::Cylinder{.point = point, .axis = axis, .radius = radius}};
  };
  const Result thick = solved(tube(false), under(false, 0.2)), thin = solved(tube(false), under(false, 0.008)),
               turned = solved(tube(true), under(true, 0.008));
  ASSERT_EQ(thin.status, Status::solved) << status_text(thin);
  ASSERT_EQ(turned.status, Status::solved) << status_text(turned);
  EXPECT_NEAR(upward(thin) / upward(thick), 1, 3e-2);
  EXPECT_NEAR(-turned.summary.reaction.force[1] / upward(thin), 1, 1e-6);
}

TEST(ASheetOfTriangles, ThinnerThanTheShellIsMetFromBelow) {
  const Obstacle sheet = box(0.3, 0.006, 0.01);
  obstacle::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.points.emplace_back(0.35 + 0.3 * (k & 1), -0.4 + 0.9 * ((k >> 1) & 1), -e / 2 + 0.004 + 0.006 * (k >> 2));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const Result exact = solved(strip(), sheet),
               triangles = solved(strip(), {.name = "sheet", .shape = obstacle::TriangleSurface(mesh)});
  ASSERT_EQ(exact.status, Status::solved) << status_text(exact);
  ASSERT_EQ(triangles.status, Status::solved) << status_text(triangles);
  EXPECT_GT(upward(exact), 0);
  EXPECT_NEAR(upward(triangles) / upward(exact), 1, 1e-3);
}

/// A wire in the middle of a cell and its nodes.
constexpr double between_nodes = 0.5 + 1.0 / 64;

TEST(AWire, ThatAllNodesMissIsNamedWithItsPlace) {
  problem::Problem p = strip();
  p.discretisation.refinements = 0;
  const Result r = solved(p, wire(0.004, 0.015, between_nodes));
  EXPECT_EQ(r.status, Status::inaccurate);
  EXPECT_THAT(r.missed_limits, HasSubstr("min_gap_between"));
  EXPECT_THAT(r.missed_limits, HasSubstr("the obstacle \"wire\" at x = 0.51"));
  p.shell.obstacles.all = {wire(0.004, 0.015, between_nodes)};
  const Verification v =
      verify(p, finest_mesh(p, MPI_COMM_WORLD), {.state = r.solution->discrete->state, .nodal = r.solution->nodal});
  EXPECT_EQ(v.result.status, Status::inaccurate);
}

TEST(AWire, ThatNodesMissIsRefinedTowards) {
  problem::Problem p = strip();
  p.discretisation.refinements = 0;
  p.accuracy = problem::Accuracy{.goals = {{"energy", 0.1}}, .max_unknowns = 4e4};
  const Result r = solved(p, wire(0.004, 0.015, between_nodes));
  ASSERT_EQ(r.status, Status::solved) << status_text(r);
  EXPECT_GT(r.summary.touching_nodes, 0);
  EXPECT_NEAR(upward(r) / upward(solved(strip(), wire(0.2, 0.015))), 1, 0.1);
}

// The first meshes see nothing of the wire, or find no place beside it. Their errors are no measure for later meshes, and rows of
// cells become narrow there.
TEST(AWire, ThatALoadBendsAPlateOverIsMetOnAFewCells) {
  for (const bool is_turned : {false, true}) {
    problem::Problem p = with_chart(free_plate(), {"x", "y", "0.01"}, {});
    p.domain = is_turned ? domain::Rectangle{.to = {0.4, 1}, .cells = {2, 4}}
                         : domain::Rectangle{.to = {1, 0.4}, .cells = {4, 2}};
    p.shell.sections.common.thickness = Expression(0.02);
    p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
    p.shell.supports =
        is_turned ? std::vector{clamped("bottom"), clamped("top")} : std::vector{clamped("left"), clamped("right")};
    p.shell.loads.on_areas = {force(0, 0, -1.3e-5)};
    const Eigen::Vector3d axis = is_turned ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    const Eigen::Vector3d across = is_turned ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    p.discretisation = {.degree = 4, .layers = problem::Layers::automatic, .refinements = 0};
    p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-2}, {"reaction", 1e-2}}, .max_unknowns = 1e4};
    const Result r =
        solved(p, {.name = "wire",
                   .shape = obstacle::Cylinder{
                       .point = 0.43 * across - 0.006 * Eigen::Vector3d::UnitZ(), .axis = axis, .radius = 0.004}});
    ASSERT_EQ(r.status, Status::solved) << status_text(r);
    EXPECT_NEAR(upward(r), 2.5355e-6, 1e-2 * 2.5355e-6);  // accuracy of 1e-4
    EXPECT_NEAR(r.summary.energy.total(), 5.5258e-9, 1e-2 * 5.5258e-9);
    EXPECT_LT(r.levels.back().unknowns, 5000);
  }
}

// Under its load the strip would hang down on both sides of a wire that no node sees, or pass it.
TEST(AWire, ThatALoadMovesTheShellPastIsNotCalledSolved) {
  problem::Problem p = strip();
  p.discretisation.refinements = 0;
  p.shell.loads.on_areas = {force(0, 0, -3e-4)};
  Obstacle below = wire(0.004, -0.004, between_nodes);
  const Result free = solve(p, MPI_COMM_WORLD);
  ASSERT_GT(free.summary.max_displacement, e / 2 + 0.012);
  const Result r = solved(p, below);
  EXPECT_NE(r.status, Status::solved);
  EXPECT_THAT(status_text(r), HasSubstr("\"wire\""));
}

TEST(ABall, ThatGoesFartherThanItIsThickIsFollowed) {
  for (const int parts : {1, 2}) {
    SCOPED_TRACE(fmt::format("{} parts", parts));
    problem::Problem p = strip();
    p.shell.obstacles.all = {wire(0.02, 0)};
    p.shell.obstacles.all[0].motions = {{.translation = {0, 0, 0.1}}};
    p.steps = {{.name = "up", .parts = parts}};
    const Result r = solve(p, MPI_COMM_WORLD), roller = solved(strip(), wire(0.2, 0.1));
    ASSERT_EQ(r.status, Status::solved) << status_text(r);
    EXPECT_EQ(r.history.size(), static_cast<std::size_t>(parts));
    EXPECT_NEAR(upward(r) / upward(roller), 1, 2e-2);
  }
}

// Between nodes, an obstacle that comes in by a small part of the thickness moves the shell more than a smaller load does.
TEST(AWire, ThatNodesMissIsNotSolvedHoweverLittleItComesIn) {
  for (const double depth : {1e-3 * e, 5e-3 * e})
    for (const double load : {0.0, 1e-9}) {
      problem::Problem p = strip();
      p.shell.loads.on_areas = {force(0, 0, -load)};
      const Result r = solved(p, wire(0.02, depth, 0.5 + 1.0 / 64));
      EXPECT_NE(r.status, Status::solved) << depth << " " << load;
      p.accuracy = problem::Accuracy{.goals = {{"reaction", 0.2}}, .max_unknowns = 2e4};
      p.discretisation.refinements = 0;
      const Result found = solved(p, wire(0.02, depth, 0.5 + 1.0 / 64));
      EXPECT_GT(upward(found), 0) << depth << " " << load;
    }
}

TEST(ABall, IsFollowedWhereAccuracyIsAskedFor) {
  problem::Problem p = strip();
  p.discretisation.refinements = 0;
  p.accuracy = problem::Accuracy{.goals = {{"energy", 0.1}}, .max_unknowns = 4e4};
  p.shell.obstacles.all = {wire(0.02, 0)};
  p.shell.obstacles.all[0].motions = {{.translation = {0, 0, 0.1}}};
  p.steps = {{.name = "up", .parts = 2}};
  const Result r = solve(p, MPI_COMM_WORLD), roller = solved(strip(), wire(0.2, 0.1));
  ASSERT_EQ(r.status, Status::solved) << status_text(r);
  EXPECT_NEAR(upward(r) / upward(roller), 1, 0.1);
}

/// A strip in plane strain on a body whose top is the plane z = 0 for 0 <= x <= 1. It hangs over both edges by one half.
problem::Problem overhanging_strip(const obstacle::Shape& body, int cells, int degree, double L) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", fmt::format("{:.17g}", 0.05 * L)}, {});
  p.domain = domain::Rectangle{.from = {-0.5 * L, 0}, .to = {1.5 * L, 0.2 * L}, .cells = {cells, 1}};
  p.shell.sections.common.thickness = Expression(0.1 * L);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e7, 0, 1);
  Support middle = held("", {Direction::x});
  middle.point = Eigen::Vector2d(0.5 * L, 0);
  p.shell.supports = {in_plane("bottom"), in_plane("top"), middle};
  p.shell.loads.on_areas = {force(0, 0, -10)};
  p.shell.obstacles.all = {{.shape = body}};
  p.probes = {{.name = "end", .at = {1.5 * L, 0.1 * L}}, {.name = "middle", .at = {0.5 * L, 0.1 * L}}};
  p.discretisation = {.degree = degree, .refinements = 0};
  return p;
}

obstacle::Shape box_of_triangles(const obstacle::Box& box) {
  obstacle::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.points.push_back(box.centre +
                          box.size.cwiseProduct(obstacle::Vector3d(k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 - 0.5)));
  for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return obstacle::TriangleSurface(mesh, "box");
}

// Timoshenko's beam on two edges. No force acts along x, whether the mesh has nodes on the edges or not. Without nodes there, the
// nearest nodes carry the forces.
TEST(SharpEdges, CarryAStripThatHangsOverThem) {
  constexpr double end = -2.2125e-4, middle = 2.875e-5;
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const double L : {1.0, 1e-3})
      for (const auto& [cells, degree, error] : {std::tuple{8, 4, 2e-4}, {20, 2, 1e-3}, {19, 4, 0.12}}) {
        const obstacle::Box box{.centre = {0.5 * L, 0.5 * L, -0.5 * L}, .size = {L, 3 * L, L}};
        for (const obstacle::Shape& body : {obstacle::Shape(box), box_of_triangles(box)}) {
          problem::Problem p = overhanging_strip(body, cells, degree, L);
          p.shell.rotations = rotations;
          const Result r = solve(p, MPI_COMM_WORLD);
          ASSERT_EQ(r.status, Status::solved) << cells << " " << r.missed_limits;
          EXPECT_NEAR(r.probes[0].values.u[2] / (end * L), 1, error) << cells << " " << L;
          EXPECT_NEAR(r.probes[1].values.u[2] / (middle * L), 1, 5 * error) << cells << " " << L;
          EXPECT_LT(std::abs(r.summary.reaction.force[0]), 1e-4 * r.summary.reaction.force[2]) << cells;
        }
      }
}

// The turn of a face moves its gap to an edge beside the node: the linearised gaps came to rest slowly, or not at all.
TEST(SharpEdges, BetweenNodesComeToRest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(0, 0.06);
  for (int i = 0; i < 12; ++i) {
    const int cells = std::uniform_int_distribution<int>(8, 40)(random), degree = 2 + i % 3;
    const double x = offset(random);
    const Result r =
        solve(overhanging_strip(obstacle::Box{.centre = {0.5 + x, 0.5, -0.5}, .size = {1, 3, 1}}, cells, degree, 1),
              MPI_COMM_WORLD);
    EXPECT_EQ(r.status, Status::solved) << cells << " cells of degree " << degree << ", " << x;
    EXPECT_LE(r.last_level().linearisations, 30) << cells << " cells of degree " << degree << ", " << x;
    EXPECT_NEAR(r.probes[0].values.u[2] / -2.2125e-4, 1, 0.6) << cells << " cells of degree " << degree << ", " << x;
  }
}

TEST(SharpTips, BetweenNodesComeToRest) {
  std::mt19937 random(2);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  int at_rest = 0;
  constexpr int tips = 12;
  for (int i = 0; i < tips; ++i) {
    problem::Problem p = free_plate();
    p.domain = domain::Rectangle{.to = {1, 0.4}, .cells = {4, 2}};
    p.shell.sections.common.thickness = Expression(0.02);
    p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
    p.shell.supports = {clamped("left"), clamped("right")};
    p.shell.loads.on_areas = {force(0, 0, -2e-5)};
    p.discretisation = {.degree = 2 + 2 * (i % 2), .refinements = 0};
    const obstacle::Cone cone{.apex = {between(0.3, 0.7), between(0.1, 0.3), between(-0.02, -0.011)},
                              .axis = {0, 0, -1},
                              .half_angle = between(0.1, 1.2),
                              .height = 0.1};
    p.shell.obstacles.all = {{.shape = cone}};
    const Result r = solve(p, MPI_COMM_WORLD);
    at_rest += r.status == Status::solved ? 1 : 0;
    EXPECT_GT(upward(r), 0) << cone.apex.transpose() << ", " << cone.half_angle;
  }
  EXPECT_GE(at_rest, tips - 2);  // five or six of them came to rest without the correction of steps
}

/// The energy of Timoshenko's beam on two edges.
double energy_on_edges(double L) { return 4.7e-3 / 60 * L * L * L; }
/// The linear model has forces on the face before or after it turned: edges differ by e r / 2, the energy by this part.
constexpr double energy_by_turn = 3e-4;

// Without nodes on the edges the nearest nodes carry the forces. The estimate knows how far they are away. Cells with an edge in their
// middle are left out: there all of the error is the kink inside of the cell.
TEST(SharpEdges, AreAsFarFromNodesAsEstimatesSay) {
  constexpr int most_finite = 20;  // cells; on some finer meshes two nodes take turns with finite rotations
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const double L : {1.0, 1e-3})
      for (const auto& [cells, degree] : {std::pair{19, 4}, {20, 4}, {21, 4}, {28, 3}, {37, 4}, {40, 2}}) {
        if (rotations == element::Rotations::finite && cells > most_finite) continue;
        const obstacle::Box box{.centre = {0.5 * L, 0.5 * L, -0.5 * L}, .size = {L, 3 * L, L}};
        for (const obstacle::Shape& body : {obstacle::Shape(box), box_of_triangles(box)}) {
          problem::Problem p = overhanging_strip(body, cells, degree, L);
          p.shell.rotations = rotations;
          const Result r = solve(p, MPI_COMM_WORLD);
          ASSERT_EQ(r.status, Status::solved) << cells << " " << r.missed_limits;
          const auto& goals = r.estimates->goals;
          const auto goal = std::ranges::find(goals, "energy", &estimation::GoalEstimate::name);
          ASSERT_NE(goal, goals.end());
          const double exact = energy_on_edges(L), error = std::abs(goal->value - exact) / exact;
          EXPECT_GT(goal->error() / exact, 0.25 * (error - energy_by_turn)) << cells << " " << degree;
          EXPECT_LT(goal->error() / exact, 4 * error + 10 * energy_by_turn) << cells << " " << degree;
        }
      }
}

// The shell lies on the body, so all gaps of the undeformed shell are zero, and so is the dual of the energy. The reactions on depths
// between nodes remain: the line of contact is up to a distance of nodes away. The rounding moves it by less than its radius.
TEST(RoundEdges, SmallerThanCellsAreAsFarFromNodesAsEstimatesSay) {
  constexpr double radius = 0.001, by_radius = 0.015;
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite})
    for (const auto& [cells, degree] : {std::pair{8, 4}, {20, 2}, {20, 4}, {40, 4}}) {
      const obstacle::Box box{.centre = {0.5, 0.5, -0.5}, .size = {1, 3, 1}, .fillet = radius};
      problem::Problem p = overhanging_strip(box, cells, degree, 1);
      p.shell.rotations = rotations;
      const Result r = solve(p, MPI_COMM_WORLD);
      ASSERT_EQ(r.status, Status::solved) << cells << " " << r.missed_limits;
      const auto& goals = r.estimates->goals;
      const auto goal = std::ranges::find(goals, "energy", &estimation::GoalEstimate::name);
      ASSERT_NE(goal, goals.end());
      const double error = std::abs(goal->value / energy_on_edges(1) - 1);
      EXPECT_GT(error, 0.05) << cells << " " << degree;
      EXPECT_GT(goal->error() / goal->value, 0.25 * (error - by_radius)) << cells << " " << degree;
    }
}

TEST(SharpEdges, NeedNoSmallCells) {
  for (const int cells : {7, 10, 13, 15, 17, 22, 37, 40}) {
    const obstacle::Box box{.centre = {0.5, 0.5, -0.5}, .size = {1, 3, 1}};
    problem::Problem p = overhanging_strip(box, cells, 4, 1);
    p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-3}, {"reaction", 1e-3}}, .max_unknowns = 1e4};
    const Result r = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(r.status, Status::solved) << status_text(r);
    EXPECT_NEAR(r.summary.energy.total() / energy_on_edges(1), 1, 1e-3) << cells;
    EXPECT_NEAR(upward(r), 4, 4e-3) << cells;
  }
}

}  // namespace
}  // namespace plastron::computation::small_obstacles_test
