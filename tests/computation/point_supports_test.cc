// Free panels supported at three points: the supports fix the six rigid motions and nothing else.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>

#include <fmt/format.h>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;
using Eigen::Vector3d;

Support at_point(double x, double y, const std::vector<Direction>& directions) {
  Support s = held("", directions);
  s.point = Eigen::Vector2d(x, y);
  return s;
}

constexpr auto X = Direction::x, Y = Direction::y, Z = Direction::z;

/// 3-2-1 supports at corners of the square that are not on one line in space.
problem::Problem held_in_three_points(problem::Problem p) {
  p.shell.supports = {at_point(0, 0, {X, Y, Z}), at_point(1, 0, {Y, Z}), at_point(0, 1, {Z})};
  return p;
}

/// In the plane and across it, without resultant and moment: Legendre polynomials.
energy::AreaLoad balanced() {
  energy::AreaLoad load;
  load.force = {Expression("x - 0.5", {}), Expression(0.0), Expression("(6*x^2 - 6*x + 1) * (1 + y)", {})};
  return load;
}

/// Lengths of a rectangle in space, turned by a rotation about an oblique axis.
Eigen::Matrix3d turned() { return Eigen::AngleAxisd(0.9, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix(); }

problem::Problem free_panel(const Eigen::Matrix3d& R = Eigen::Matrix3d::Identity()) {
  std::array<std::string, 3> chart;
  energy::AreaLoad load = balanced();
  const auto f = balanced().force;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    chart[k] = fmt::format("{:.17g}*x + {:.17g}*y", R(i, 0), R(i, 1));
    load.force[k] =
        Expression(fmt::format("{:.17g}*({}) + {:.17g}*({})", R(i, 0), f[0].text(), R(i, 2), f[2].text()), {});
  }
  problem::Problem p = held_in_three_points(with_chart(free_plate(), chart));
  p.shell.loads.on_areas = {load};
  return p;
}

void expect_no_reaction(const Result& result, double tolerance = 1e-10) {
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  ASSERT_EQ(result.summary.point_reactions.size(), 3u);
  EXPECT_GT(result.summary.load_norms, 0.1);
  for (const auto& reaction : result.summary.point_reactions)
    EXPECT_LT(reaction.force.norm(), tolerance * result.summary.load_norms) << reaction.at.transpose();
}

TEST(FreePanel, under_loads_in_equilibrium_needs_no_reaction) {
  for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle})
    for (const auto formulation : {element::Formulation::tangent, element::Formulation::classical}) {
      problem::Problem p = free_panel();
      p.discretisation = {.cells = shape, .degree = 2, .refinements = 2};
      p.shell.tying = shape == mesh::Shape::quadrilateral;
      p.shell.tangency.formulation = formulation;
      const Result result = solve(p, MPI_COMM_WORLD);
      expect_no_reaction(result);
      EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
      EXPECT_GT(result.summary.max_displacement, 1e-5);
    }
}

// These formulations contain only gradients of r . a_3. So a boundary must prescribe that it vanishes, which causes no force.
TEST(FreePanel, of_relaxed_formulations_needs_r_a3_on_a_boundary) {
  for (const auto formulation : {element::Formulation::penalised, element::Formulation::mixed}) {
    problem::Problem p = free_panel();
    p.shell.tangency.formulation = formulation;
    EXPECT_TRUE(has_errors(examination::examine(p)));
    p.shell.supports.push_back({.boundary = "left", .components = {fixed(Unknown::rotation, Direction::normal)}});
    EXPECT_FALSE(has_errors(examination::examine(p)));
    expect_no_reaction(solve(p, MPI_COMM_WORLD));
  }
}

TEST(FreePanel, that_is_turned_has_the_same_strains) {
  const Result flat = solve(free_panel(), MPI_COMM_WORLD), askew = solve(free_panel(turned()), MPI_COMM_WORLD);
  expect_no_reaction(askew);
  const auto &a = flat.summary.energy, &b = askew.summary.energy;
  EXPECT_GT(std::min({a.membrane, a.bending, a.shear}), 0);
  EXPECT_NEAR(a.membrane / b.membrane, 1, 1e-9);
  EXPECT_NEAR(a.bending / b.bending, 1, 1e-9);
  EXPECT_NEAR(a.shear / b.shear, 1, 1e-9);
}

TEST(FreePanel, has_the_same_strains_whichever_points_hold_it) {
  problem::Problem p = free_panel();
  const double energy = solve(p, MPI_COMM_WORLD).summary.energy.total();
  // Middles of sides and of the square: corners of cells. And prescribed motions, as long as they are rigid.
  p.shell.supports = {at_point(0.5, 0.5, {X, Y, Z}), at_point(0.5, 1, {X, Z}), at_point(0, 0.5, {Z})};
  p.shell.supports[0].components[2].value = Expression(0.3);
  EXPECT_FALSE(has_errors(examination::examine(p)));
  const Result other = solve(p, MPI_COMM_WORLD);
  expect_no_reaction(other);
  EXPECT_NEAR(other.summary.energy.total() / energy, 1, 1e-9);
}

/// A cylinder of radius 1 over the square, under a load in equilibrium.
problem::Problem curved_panel(int degree) {
  problem::Problem p = held_in_three_points(with_chart(free_plate(), {"sin(x - 0.5)", "y", "cos(x - 0.5)"}));
  // Along y. Resultant and moments are zero because the surface element is one and the section is symmetric.
  energy::AreaLoad load;
  load.force[1] = Expression("cos(2*(x - 0.5)) * (2*y - 1)", {});
  p.shell.loads.on_areas = {load};
  p.discretisation.degree = degree;
  return p;
}

TEST(CurvedPanel, needs_reactions_no_larger_than_what_its_mesh_misses) {
  for (const int degree : {2, 3, 4}) {
    const Result result = solve(curved_panel(degree), MPI_COMM_WORLD);
    expect_no_reaction(result, degree == 2 ? 1e-2 : degree == 3 ? 1e-3 : 1e-4);
    for (const std::string& warning : result.warnings)
      EXPECT_NE(warning.find("though these are in equilibrium"), std::string::npos) << warning;
  }
}

// Statics: the two ends of the diagonal carry the weight 0.1 of the middle.
TEST(Points, under_a_weight_carry_it_and_say_that_this_is_singular) {
  problem::Problem p = held_in_three_points(free_plate());
  p.shell.loads.on_areas = {force(0, 0, -0.1)};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.summary.point_reactions.size(), 3u);
  const std::array<Vector3d, 3> expected{Vector3d::Zero(), Vector3d(0, 0, 0.05), Vector3d(0, 0, 0.05)};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_LT((result.summary.point_reactions[k].force - expected[k]).norm(), 1e-9) << k;
  EXPECT_EQ(result.summary.point_reactions[1].at, Eigen::Vector2d(1, 0));
  EXPECT_NEAR(result.summary.load_norms, 0.1, 1e-12);
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_NE(result.warnings[0].find("carries 0.05 N"), std::string::npos) << result.warnings[0];
  EXPECT_NE(result.warnings[0].find("singular"), std::string::npos);
}

TEST(Points, that_move_a_shell_rigidly_are_nothing_to_warn_of) {
  problem::Problem p = held_in_three_points(free_plate());
  p.shell.supports[2].components[0].value = Expression(0.01);
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_LT(result.summary.energy.total(), 1e-20);
  EXPECT_NEAR(result.summary.max_displacement, 0.01, 1e-10);
}

TEST(Points, must_be_nodes_that_all_meshes_have) {
  const auto error = [](problem::Problem p, double x, double y) {
    p.shell.supports.push_back(at_point(x, y, {Z}));
    for (const auto& finding : examination::examine(p))
      if (finding.severity == examination::Severity::error) return finding.text;
    return std::string();
  };
  problem::Problem p = free_panel();  // 2 x 2 cells of degree 2: the middles of their sides are nodes
  EXPECT_EQ(error(p, 0.25, 0.75), "");
  EXPECT_NE(error(p, 0.25, 0.7).find("the nearest one is (0.25, 0.75)"), std::string::npos);
  p.discretisation.degree = 3;
  EXPECT_NE(error(p, 0.25, 0.5 + 1e-3).find("the nearest one is"), std::string::npos);
  EXPECT_EQ(error(p, 0.5, 1), "");
  EXPECT_EQ(error(p, 0.5 + 1e-10, 1), "");
  p.shell.supports.push_back(at_point(0.3, 0.3, {Z}));
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), assembly::SupportError);
}

}  // namespace
}  // namespace plastron::computation
