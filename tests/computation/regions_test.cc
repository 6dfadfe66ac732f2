// Thickness, material and loads by region: cantilevers of two spans with the closed forms of beams.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/meshing/sequence.hpp>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation::regions_test {
namespace {

using namespace test;

constexpr double first = 0.8, second = 1.2, width = 0.5;  // lengths of the spans from the clamped end, and the width

/// One span: E, e, and the stiffnesses of a strip without Poisson's effect.
struct Span {
  double young, thickness;
  double bending() const { return young * std::pow(thickness, 3) / 12; }
  double shear() const { return young / 2 * thickness; }
  energy::CrossSection section() const {
    return {.thickness = Expression(thickness), .material = shell::Material::from_young_poisson(young, 0, 1)};
  }
};
constexpr Span stiff{2e4, 0.12}, soft{5e3, 0.1};

problem::Problem two_spans() {
  problem::Problem p = free_plate();
  p.domain = domain::Rectangle{
      .to = {first + second, width}, .cells = {5, 1}, .breaks = {first}, .regions = {"stiff", "soft"}};
  p.shell.sections.common = soft.section();
  p.shell.sections.regions["stiff"] = stiff.section();
  p.shell.supports = {clamped("left")};
  p.probes = {{.name = "tip", .at = {first + second, width / 2}}};
  p.discretisation = {.degree = 3, .refinements = 1};
  return p;
}

/// F per width at the tip: int (L - x)^2 / D dx and int 1 / (k mu e) dx.
double deflection_under_end_force() {
  const double whole = std::pow(first + second, 3), rest = std::pow(second, 3);
  return (whole - rest) / (3 * stiff.bending()) + rest / (3 * soft.bending()) + first / stiff.shear() +
         second / soft.shear();
}

/// q per area on the second span alone.
double deflection_under_load_on_the_second() {
  const double a = first, b = second;
  return std::pow(b, 4) / (8 * soft.bending()) +
         b * (std::pow(a, 3) / 3 + 3 * b * a * a / 4 + b * b * a / 2) / stiff.bending() + b * b / (2 * soft.shear()) +
         b * a / stiff.shear();
}

double tip(const problem::Problem& p) {
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  return result.probes.at(0).values.u[2];
}

problem::Problem with_end_force() {
  problem::Problem p = two_spans();
  p.shell.loads.on_edges = {{.boundary = "right", .force = vector(0, 0, 1)}};
  return p;
}

TEST(TwoSpans, bend_under_an_end_force_as_a_beam_in_every_formulation) {
  problem::Problem p = with_end_force();
  const double exact = deflection_under_end_force();
  for (const auto formulation : {element::Formulation::tangent, element::Formulation::penalised,
                                 element::Formulation::mixed, element::Formulation::classical}) {
    p.shell.tangency.formulation = formulation;
    EXPECT_NEAR(tip(p) / exact, 1, 1e-8) << element::to_string(formulation);
  }
}

TEST(TwoSpans, under_a_load_on_one_of_them_bend_as_a_beam) {
  problem::Problem p = two_spans();
  p.discretisation.degree = 4;
  p.shell.loads.on_areas = {force(0, 0, 1)};
  p.shell.loads.on_areas.front().regions = {"soft"};
  EXPECT_NEAR(tip(p) / deflection_under_load_on_the_second(), 1, 1e-8);
  // The same as two loads, one of which the other takes away on the first span.
  p.shell.loads.on_areas = {force(0, 0, 1), force(0, 0, -1)};
  p.shell.loads.on_areas.back().regions = {"stiff"};
  EXPECT_NEAR(tip(p) / deflection_under_load_on_the_second(), 1, 1e-8);
}

TEST(TwoSpans, of_triangles_converge_to_the_beam) {
  problem::Problem p = with_end_force();
  p.discretisation = {.cells = mesh::Shape::triangle, .degree = 2};
  p.shell.tying = false;
  const auto error = [&](int refinements) {
    p.discretisation.refinements = refinements;
    return std::abs(tip(p) / deflection_under_end_force() - 1);
  };
  const double coarse = error(1), fine = error(2);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, coarse / 6);
}

TEST(TwoSpans, have_resultants_and_energy_of_their_own_material) {
  problem::Problem p = with_end_force();
  p.probes.push_back({.name = "in the first", .at = {0.3, 0.2}});
  p.probes.push_back({.name = "in the second", .at = {1.5, 0.2}});
  const Result result = solve(p, MPI_COMM_WORLD);
  EXPECT_NEAR(result.summary.energy.total(), deflection_under_end_force() * width / 2,
              1e-8 * result.summary.energy.total());
  for (const ProbeValue& v : result.probes) {
    EXPECT_NEAR(std::abs(v.values.M[0]), first + second - v.values.x[0], 1e-6) << v.name;
    EXPECT_EQ(v.values.thickness, v.values.x[0] < first ? stiff.thickness : soft.thickness);
  }
}

TEST(TwoSpans, that_a_region_makes_one_are_one) {
  problem::Problem p = with_end_force(), uniform = p;
  p.shell.sections.regions = {{"stiff", soft.section()}};
  uniform.shell.sections.regions.clear();
  EXPECT_EQ(tip(p), tip(uniform));
}

/// The largest thickness at nodes of the joint; elsewhere the thickness of the region.
TEST(NodalThickness, is_the_largest_where_regions_meet) {
  for (const auto shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    problem::Problem p = two_spans();
    p.discretisation = {.cells = shape, .degree = 2, .refinements = 1};
    p.shell.tying = false;
    for (const bool is_first_thicker : {true, false}) {
      if (!is_first_thicker) p.shell.sections = {.common = stiff.section(), .regions = {{"stiff", soft.section()}}};
      const double at_first = is_first_thicker ? stiff.thickness : soft.thickness,
                   at_second = is_first_thicker ? soft.thickness : stiff.thickness;
      fem::MeshSequence meshes = meshing::mesh_sequence(p, MPI_COMM_WORLD);
      meshes.refine({});
      const fem::Surface surface(meshes.space()->coarse, p.charts);
      const auto tables = element::element_tables(shape, 2, false);
      int joint = 0;
      for (const auto& point : assembly::nodal_geometry(*meshes.space(), surface, tables, p.shell.sections)) {
        const bool is_joint = std::abs(point.x[0] - first) < 1e-9;
        joint += is_joint;
        EXPECT_EQ(point.thickness, is_joint ? stiff.thickness : point.x[0] < first ? at_first : at_second);
      }
      EXPECT_GT(algebra::sum_over_ranks(static_cast<std::int64_t>(joint), MPI_COMM_WORLD), 0);
    }
  }
}

TEST(Contact, of_regions_of_different_thickness_begins_at_the_thicker_one) {
  problem::Problem p = with_chart(two_spans(), {"x", "y", "0.07"});  // the faces lie 0.01 and 0.02 above the table
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  p.shell.loads.on_areas = {force(0, 0, -1e-3)};
  const Result free = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(free.summary.touching_nodes, 0);
  EXPECT_LT(free.certificate.min_gap_nodes, 0.0101);
  p.shell.supports = {clamped("left"), clamped("right")};
  p.shell.loads.on_areas = {force(0, 0, -4)};
  const Result pressed = solve(p, MPI_COMM_WORLD);
  EXPECT_EQ(pressed.status, contact::Status::solved) << pressed.missed_limits;
  EXPECT_GT(pressed.summary.touching_nodes, 0);
  EXPECT_GE(pressed.certificate.min_gap_nodes, -1e-12);
}

TEST(Examination, sees_the_thickness_and_loads_of_each_region) {
  const auto texts = [](const problem::Problem& p) {
    std::string all;
    for (const auto& finding : examination::examine(p))
      if (finding.severity != examination::Severity::note) all += finding.text + "\n";
    return all;
  };
  problem::Problem p = with_end_force();
  EXPECT_EQ(texts(p), "");
  p.shell.sections.regions["stiff"].thickness = Expression("x < 0.33 ? 0.1 : 0.2", {});
  EXPECT_NE(texts(p).find("jumps inside of a cell near x = 0.33"), std::string::npos) << texts(p);
  p = with_end_force();
  p.shell.sections.regions["soft"].thickness = Expression("1.5 - x", {});
  EXPECT_NE(texts(p).find("it must be positive"), std::string::npos) << texts(p);
  // A function of one region need not be smooth in the other region.
  p = with_end_force();
  p.shell.sections.regions["stiff"].thickness = Expression("x < 1.234 ? 0.12 : -1", {});
  p.shell.loads.on_areas = {force(0, 0, 0)};
  p.shell.loads.on_areas.front().pressure = Expression("1 / (x - 0.5)", {});
  p.shell.loads.on_areas.front().regions = {"soft"};
  EXPECT_EQ(texts(p), "");
  p.shell.loads.on_areas.front().regions = {"stiff"};
  EXPECT_NE(texts(p).find("on the region \"stiff\""), std::string::npos) << texts(p);
  p = with_end_force();
  p.shell.sections.regions["wing"] = soft.section();
  EXPECT_NE(texts(p).find("the region \"wing\", which the mesh does not have; it has: stiff, soft"), std::string::npos);
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), mesh::DomainError);
}

}  // namespace
}  // namespace plastron::computation::regions_test
