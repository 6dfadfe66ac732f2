// Raasch's hook: a thick strip of two arcs that bend to opposite sides, clamped at one end and sheared along its width
// at the other. The arcs meet smoothly, where the curvature jumps. The strip bends and twists at once, which many shell
// elements get wrong. Lengths in inches.
#include "domain/space_surface.hpp"

#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace plastron::verification::raasch_hook_test {
namespace {

using assembly::Direction, assembly::Unknown;
using Eigen::Vector3d;
using namespace topology::space_meshes;  // NOLINT: builders of meshes
using namespace domain::space_meshes;    // NOLINT: builders of meshes
using std::numbers::pi;

constexpr double width = 20, small = 14, large = 46, small_angle = pi / 3, large_angle = 5 * pi / 6;
/// Deflection of the tip along the width, to which meshes of solid elements with 20 nodes tend: C3D20R of CalculiX
/// gives 5.0174 with 54 x 8 x 2 elements and 5.0198 with 88 x 20 x 2.
constexpr double solid_deflection = 5.022;

/// A point of the small arc, which begins at the clamped end.
Vector3d on_small(double angle, double y) { return {small * (1 - std::cos(angle)), y, small * std::sin(angle)}; }

/// A point of the large arc, which begins where the small one ends and bends to the other side.
Vector3d on_large(double angle, double y) {
  const double turned = small_angle - angle;
  return on_small(small_angle, y) +
         large * Vector3d(std::cos(turned) - std::cos(small_angle), 0, std::sin(small_angle) - std::sin(turned));
}

/// Numbers of cells along the arcs and across the width.
struct Cells {
  int small = 3, large = 25, across = 2;
};

domain::FileSurface hook(const Cells& cells, int order) {
  topology::SpaceMesh mesh{.shape = mesh::Shape::quadrilateral, .nodes = {}, .cells = {}};
  add_grid(
      {cells.small, cells.across, order}, [](double s, double t) { return on_small(s * small_angle, width * t); },
      mesh);
  add_grid(
      {cells.large, cells.across, order}, [](double s, double t) { return on_large(s * large_angle, width * t); },
      mesh);
  const Vector3d tip = on_large(large_angle, 0);
  return surface_of(glued(std::move(mesh)),
                    {{"clamped", [](const Vector3d& p) { return std::hypot(p[0], p[2]) < 1e-9; }},
                     {"tip", [=](const Vector3d& p) { return std::hypot(p[0] - tip[0], p[2] - tip[2]) < 1e-9; }}});
}

/// Fixes and loads the two named boundaries; a pound in all pulls along the width.
void load(const std::string& clamped, const std::string& tip, problem::Problem& problem) {
  problem.shell.sections.common.thickness = geometry::Expression(2.0);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(3300, 0.35, 5.0 / 6);
  assembly::Support support{.boundary = clamped};
  for (const Unknown unknown : {Unknown::displacement, Unknown::rotation})
    for (const Direction d : {Direction::x, Direction::y, Direction::z})
      support.components.push_back({unknown, d, geometry::Expression(0.0)});
  problem.shell.supports = {support};
  energy::EdgeLoad shear{.boundary = tip};
  shear.force[1] = geometry::Expression(1 / width);
  problem.shell.loads.on_edges = {shear};
}

/// Deflections along the width at both corners and in the middle of the tip.
std::array<double, 3> deflections(problem::Problem problem) {
  problem::locate_points(problem);
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved);
  return {result.probes[0].values.u[1], result.probes[1].values.u[1], result.probes[2].values.u[1]};
}

std::array<double, 3> by_mesh(const Cells& cells, int order) {
  problem::Problem problem;
  problem.domain = domain_of(hook(cells, order));
  problem.discretisation = {.degree = 4, .refinements = 1};
  load("clamped", "tip", problem);
  for (const double y : {0.0, width / 2, width})
    problem.probes.push_back({.name = fmt::format("{}", y), .in_space = on_large(large_angle, y)});
  return deflections(problem);
}

/// The hook of two charts on the cells of Cells{}: x is the length along the arcs.
std::array<double, 3> by_charts() {
  const double join = small * small_angle, end = join + large * large_angle;
  const geometry::Constants constants{{"s", join}, {"a", small_angle}};
  problem::Problem problem;
  problem.domain =
      domain::Rectangle{.to = {end, width}, .cells = {28, 2}, .breaks = {join}, .regions = {"small", "large"}};
  problem.charts.emplace("small", geometry::Chart({"14*(1 - cos(x/14))", "y", "14*sin(x/14)"}, constants));
  problem.charts.emplace("large", geometry::Chart({"14*(1 - cos(a)) + 46*(cos(a - (x - s)/46) - cos(a))", "y",
                                                   "14*sin(a) + 46*(sin(a) - sin(a - (x - s)/46))"},
                                                  constants));
  problem.discretisation = {.degree = 4, .refinements = 1};
  load("left", "right", problem);
  for (const double y : {0.0, width / 2, width})
    problem.probes.push_back({.name = fmt::format("{}", y), .at = {end, y}});
  return deflections(problem);
}

TEST(RaaschHook, IsSmoothWhereItsCurvatureJumps) {
  for (const int order : {1, 2, 4})
    for (const topology::SurfaceEdge& edge : hook({}, order).topology.edges)
      EXPECT_TRUE(edge.kind == topology::EdgeKind::smooth || edge.kind == topology::EdgeKind::border) << order;
}

TEST(RaaschHook, HasTheDeflectionOfItsChartsAndOfSolids) {
  const std::array<double, 3> exact = by_charts();
  fmt::print("Raasch's hook by charts: {:.6f} {:.6f} {:.6f}\n", exact[0], exact[1], exact[2]);
  EXPECT_NEAR(exact[1], solid_deflection, 5e-3 * solid_deflection);
  const std::vector<std::pair<int, double>> limits{{1, 6e-3}, {2, 5e-6}, {4, 2e-7}};
  for (const auto& [order, limit] : limits) {
    const std::array<double, 3> found = by_mesh({}, order);
    fmt::print("Raasch's hook of order {}: {:.6f} {:.6f} {:.6f}, differences {:.1e} {:.1e} {:.1e}\n", order, found[0],
               found[1], found[2], found[0] / exact[0] - 1, found[1] / exact[1] - 1, found[2] / exact[2] - 1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], exact[k], limit * exact[k]) << order;
    EXPECT_NEAR(found[0], found[2], 1e-8 * exact[0]) << order;
  }
}

// The error of facets falls with the square of their size.
TEST(RaaschHook, OfFacetsConvergesToItsDeflection) {
  const double exact = by_charts()[1], coarse = by_mesh({3, 9, 2}, 1)[1], fine = by_mesh({6, 18, 2}, 1)[1];
  fmt::print("Raasch's hook of facets: errors {:.1e} {:.1e}\n", coarse / exact - 1, fine / exact - 1);
  EXPECT_LT(std::abs(coarse - exact), 1e-2 * exact);
  EXPECT_LT(std::abs(fine - exact), 0.4 * std::abs(coarse - exact));
}

}  // namespace
}  // namespace plastron::verification::raasch_hook_test
