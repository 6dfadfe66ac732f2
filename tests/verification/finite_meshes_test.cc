// Finite rotations on meshes in space: at small loads the numbers of the linear model, and rigid turns without energy, on curved cells,
// folds and branches.
#include "domain/space_surface.hpp"

#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace plastron::verification::finite_meshes_test {
namespace {

using assembly::Direction, assembly::Unknown;
using Eigen::Vector3d;
using mesh::Shape;
using std::numbers::pi;
using namespace topology::space_meshes;  // NOLINT: builders of meshes
using namespace domain::space_meshes;    // NOLINT: builders of meshes

struct Part {
  std::string name;
  topology::SpaceMesh mesh;
  int degree = 2;
};

/// A quarter of a ring round the y axis, which stands on the x axis.
topology::SpaceMesh arc(Shape shape, const Grid& grid) {
  topology::SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  const auto place = [](double s, double t) { return Vector3d(std::cos(pi / 2 * s), 0.3 * t, std::sin(pi / 2 * s)); };
  add_grid(grid, place, mesh);
  return mesh;
}

/// A plate with a rib of height one half, a fold at its side, and a plate across the ends of both.
topology::SpaceMesh rib_beside_a_fold(Shape shape) {
  topology::SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  const Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const double at : {0.0, 1.0}) add_grid({1, 1, 1}, plate((at - 1) * x, x, y), mesh);
  for (const double at : {-1.0, 0.0}) add_grid({1, 1, 1}, plate(at * x, 0.5 * z, y), mesh);
  for (const double at : {-1.0, 0.0}) add_grid({1, 1, 1}, plate(at * x, x, 0.5 * z), mesh);
  return glued(std::move(mesh));
}

/// Parts with the border x = 1.
std::vector<Part> parts() {
  std::vector<Part> all;
  for (const Shape shape : shapes) {
    const bool is_quadrilateral = shape == Shape::quadrilateral;
    const std::string cells = is_quadrilateral ? "" : ", triangles";
    for (int order = 1; order <= (is_quadrilateral ? 4 : 2); ++order)
      for (int degree = order; degree <= (is_quadrilateral ? 4 : 2); ++degree)
        all.push_back(
            {fmt::format("arc of order {}, degree {}{}", order, degree, cells), arc(shape, {3, 1, order}), degree});
    all.push_back({"T" + cells, star(shape, 1, 1, {0, pi / 2, pi})});
    all.push_back({"cross" + cells, star(shape, 1, 1, {0, pi / 2, pi, 3 * pi / 2})});
    all.push_back({"star of five" + cells, star(shape, 1, 1, {0, 1, 2.4, pi, 5})});
    all.push_back({"rib beside a fold" + cells, rib_beside_a_fold(shape)});
  }
  return all;
}

problem::Problem problem_on(const Part& part) {
  problem::Problem problem;
  const auto surface =
      surface_of(part.mesh, {{"end", [](const Vector3d& p) { return p[0] > 1 - 1e-9; }}}, {.smooth_angle = 0.6});
  problem.domain = domain_of(surface);
  problem.shell.sections.common.thickness = geometry::Expression(0.02);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1e7, 0.3, 5.0 / 6);
  problem.shell.tying = part.mesh.shape == Shape::quadrilateral;
  problem.discretisation = {.cells = part.mesh.shape, .degree = part.degree, .refinements = 0};
  return problem;
}

/// The same, clamped where x = 1.
problem::Problem clamped(const Part& part) {
  problem::Problem p = problem_on(part);
  p.shell.supports = {{.boundary = "end", .components = {}}};
  for (const auto unknown : {Unknown::displacement, Unknown::rotation})
    for (const auto direction : {Direction::x, Direction::y, Direction::z})
      p.shell.supports[0].components.push_back({unknown, direction, geometry::Expression(0.0)});
  p.checks_model = false;
  return p;
}

computation::Result solved(const problem::Problem& problem, const std::string& name) {
  computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << name << " " << result.missed_limits;
  return result;
}

TEST(FiniteRotations, HaveTheNumbersOfTheLinearModelAtSmallLoads) {
  for (const Part& part : parts()) {
    problem::Problem p = clamped(part);
    energy::AreaLoad load;
    for (std::size_t k = 0; k < 3; ++k) load.force[k] = geometry::Expression(1e-5 * (1 + static_cast<double>(k)));
    p.shell.loads.on_areas = {load};
    const double linear = solved(p, part.name).summary.energy.total();
    p.shell.rotations = element::Rotations::finite;
    EXPECT_NEAR(solved(p, part.name).summary.energy.total() / linear, 1, 1e-5) << part.name;
  }
}

TEST(FiniteRotations, RestInOneOrTwoStepsWithoutLoads) {
  for (const Part& part : parts())
    for (int refinements = 0; refinements <= (part.degree > 2 ? 1 : 2); ++refinements)
      for (const double thickness : {0.02, 1e-4}) {
        problem::Problem p = clamped(part);
        p.shell.rotations = element::Rotations::finite;
        p.shell.sections.common.thickness = geometry::Expression(thickness);
        p.discretisation.refinements = refinements;
        const std::string name = fmt::format("{}, refined {} times, thickness {}", part.name, refinements, thickness);
        const computation::Result result = solved(p, name);
        EXPECT_LT(result.summary.energy.total(), 1e-27 * 1e7 * thickness) << name;
        EXPECT_LE(result.levels.back().iterations, 2) << name;
      }
}

TEST(FiniteRotations, TurnWithABodyWithoutEnergy) {
  for (const Part& part : parts()) {
    problem::Problem p = problem_on(part);
    p.rigid_bodies = {{.name = "holder", .boundaries = {"end"}, .fixed = {0.0, 0.0, 0.1, 0.3, 1.2, -0.4}}};
    p.shell.rotations = element::Rotations::finite;
    const computation::Result result = solved(p, part.name);
    EXPECT_LT(result.summary.energy.total(), 1e-11 * 1e7 * 0.02) << part.name;
    EXPECT_GT(result.summary.max_rotation, 1) << part.name;
  }
}

}  // namespace
}  // namespace plastron::verification::finite_meshes_test
