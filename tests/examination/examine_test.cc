// The examination finds mistakes and their places, and none in good problems.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/examination/examine.hpp>

#include "computation/problems.hpp"
#include "examination/findings.hpp"

namespace plastron::examination {
namespace {

using namespace test;

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

problem::Problem two_regions(const std::array<std::string, 3>& second) {
  problem::Problem p = cantilever_plate();
  p.domain = domain::Rectangle{.to = {2, 1}, .cells = {2, 1}, .breaks = {1}, .regions = {"flat", "other"}};
  p.charts.clear();
  p.charts.emplace("flat", Chart({"x", "y", "0"}, {}));
  p.charts.emplace("other", Chart(second, {}));
  return p;
}

// ---- good problems -------------------------------------------------------------------------------------------------

std::vector<problem::Problem> good_problems() {
  std::vector<problem::Problem> all{cantilever_plate(), pressed_strip(), pressed_bowl(),
                                    two_regions({"1 + sin(x - 1)", "y", "1 - cos(x - 1)"})};
  all.push_back(with_chart(cantilever_plate(), {"2*sin(x/2)", "y", "2*cos(x/2)"}));
  all.push_back(with_chart(cantilever_plate(), {"x", "y", "x^2 - y^2"}));
  problem::Problem quarter = free_plate();
  quarter.shell.supports = {symmetry("left"), symmetry("bottom"), held("right", {Direction::z})};
  all.push_back(quarter);
  problem::Problem quarter_cylinder = with_chart(free_plate(), {"sin(x)", "y", "cos(x)"});
  quarter_cylinder.shell.supports = {symmetry("left"), symmetry("bottom"), clamped("top")};
  all.push_back(quarter_cylinder);
  problem::Problem probed = cantilever_plate();
  probed.probes = {{.name = "corner", .at = {1, 1}}, {.name = "middle", .at = {0.5, 0.5}}};
  all.push_back(probed);
  problem::Problem polygon = cantilever_plate();
  polygon.domain = domain::Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  polygon.shell.supports = {clamped("edge6")};
  all.push_back(polygon);
  return all;
}

/// A plate of thickness 0.1 between a floor and a lid that comes down by `way`, `room` apart at the start.
problem::Problem between_planes(double room, double way) {
  problem::Problem p = free_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y})};
  p.shell.obstacles.all = {
      {.name = "floor", .shape = obstacle::HalfSpace{.point = {0, 0, -0.05}}},
      {.name = "lid", .shape = obstacle::HalfSpace{.point = {0, 0, room - 0.05}, .normal = {0, 0, -1}}}};
  if (way == 0) return p;
  p.shell.obstacles.all[1].motions = {{.translation = {0, 0, -way}}};
  p.steps = {{.name = "down", .parts = 4}};
  return p;
}

TEST(Obstacles, nearer_than_the_shell_is_thick_are_named_with_place_and_time) {
  EXPECT_THAT(errors(between_planes(0.098, 0)),
              testing::Contains(AllOf(HasSubstr("\"floor\""), HasSubstr("\"lid\""), HasSubstr("leave 0.098 m"))));
  EXPECT_THAT(errors(between_planes(0.11, 0.02)),
              testing::Contains(AllOf(HasSubstr("\"lid\""), HasSubstr("time 0.75"))));
  for (const double way : {0.0, 0.01})
    for (const std::string& error : errors(between_planes(0.11, way)))
      EXPECT_THAT(error, testing::Not(HasSubstr("thick")));
}

TEST(Obstacles, that_are_round_and_leave_no_room_are_a_warning) {
  problem::Problem p = between_planes(0.11, 0);
  p.shell.obstacles.all[1].shape = obstacle::Ball{.centre = {0.5, 0.5, 0.24}, .radius = 0.2};
  EXPECT_THAT(warnings(p), testing::Contains(AllOf(HasSubstr("\"lid\""), HasSubstr("0.09 m"))));
}

/// A steel plate with E and density in the units of the case, times factors of a mistake.
problem::Problem steel_plate(const problem::UnitNames& units, double modulus_factor, double density_factor) {
  problem::Problem p = test::free_plate();
  for (const char* side : {"left", "right", "bottom", "top"}) p.shell.supports.push_back(test::clamped(side));
  p.output.units = units;
  p.shell.sections.common.material =
      shell::Material::from_young_poisson(modulus_factor * 2.1e11 / units.in_SI(1, -2).value_or(1), 0.3, 1);
  p.shell.sections.common.density = density_factor * 7850 / units.in_SI(1, -4).value_or(1);
  p.shell.loads.gravity = {0, 0, -9.81};
  return p;
}

TEST(Materials, are_compared_with_real_ones_in_the_units_of_the_case) {
  const auto in = [](const char* length, const char* force) { return problem::UnitNames{length, force, true}; };
  for (const problem::UnitNames& units : {in("m", "N"), in("mm", "N"), in("m", "kN"), in("mm", "kN"), in("in", "lbf"),
                                          in("cm", "daN"), in("um", "mN"), in("ft", "kip")}) {
    EXPECT_THAT(warnings(steel_plate(units, 1, 1)), IsEmpty()) << units.length << units.force;
    for (const double factor : {1e-6, 1e6}) {
      const auto word = factor < 1 ? "below" : "above";
      EXPECT_THAT(warnings(steel_plate(units, factor, 1)),
                  ElementsAre(AllOf(HasSubstr("modulus of elasticity"), HasSubstr(word), HasSubstr(units.length))));
      EXPECT_THAT(warnings(steel_plate(units, 1, factor)), ElementsAre(AllOf(HasSubstr("density"), HasSubstr(word))));
    }
  }
  // Without units, numbers without units, or in unknown ones, mean nothing.
  for (const problem::UnitNames& units : {problem::UnitNames{}, in("furlong", "N")})
    EXPECT_THAT(warnings(steel_plate(units, 1e-6, 1e6)), IsEmpty());
}

TEST(Weight, that_nothing_pulls_at_is_told_unless_the_shell_shall_vibrate) {
  problem::Problem p = cantilever_plate();
  p.shell.sections.common.density = 7850;
  EXPECT_THAT(texts(p, Severity::warning), ElementsAre(HasSubstr("nothing pulls")));
  p.modes.vibration = 1;
  EXPECT_THAT(texts(p, Severity::warning), IsEmpty());
}

TEST(GoodProblem, is_only_described) {
  for (const problem::Problem& p : good_problems()) {
    const auto findings = examine(p);
    EXPECT_FALSE(has_errors(findings));
    EXPECT_FALSE(findings.empty());
    for (const Finding& f : findings) EXPECT_EQ(f.severity, Severity::note) << f.text;
  }
}

TEST(GoodProblem, has_its_area_thickness_and_gap_reported) {
  const auto notes = texts(pressed_strip(), Severity::note);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("area 0.125 m^2")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("thickness: 0.05 to 0.05 m")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("initial gap: 0.01 m")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("no rigid motion is left free")));
}

// ---- surface -------------------------------------------------------------------------------------------------------

TEST(Examination, finds_a_chart_with_parallel_tangents) {
  EXPECT_THAT(errors(with_chart(cantilever_plate(), {"x + y", "x + y", "0"})),
              ElementsAre(AllOf(HasSubstr("degenerate"), HasSubstr("x = "))));
}

TEST(Examination, finds_a_chart_that_is_degenerate_at_an_edge_only) {
  problem::Problem polar = with_chart(cantilever_plate(), {"x*cos(y)", "x*sin(y)", "0"});
  polar.shell.supports = {clamped("right")};
  EXPECT_THAT(errors(polar), ElementsAre(AllOf(HasSubstr("degenerate"), HasSubstr("x = 0,"))));
}

TEST(Examination, finds_a_pole_whose_tangent_is_zero_up_to_rounding) {
  problem::Problem dome =
      with_chart(cantilever_plate(), {"cos(t*y)*cos(x)", "cos(t*y)*sin(x)", "sin(t*y)"}, {{"t", M_PI / 2}});
  ASSERT_NE(std::cos(M_PI / 2), 0);
  EXPECT_THAT(errors(dome), ElementsAre(AllOf(HasSubstr("degenerate"), HasSubstr("y = 1"))));
  EXPECT_THAT(errors(with_chart(dome, {"cos(t*y)*cos(x)", "cos(t*y)*sin(x)", "sin(t*y)"}, {{"t", 1.5}})), IsEmpty());
}

TEST(Examination, finds_a_plate_that_is_thicker_than_a_shell_may_be) {
  problem::Problem p = with_chart(cantilever_plate(), {"500*x", "500*y", "0"});
  p.shell.sections.common.thickness = Expression(600.0);
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("600 m thick"), HasSubstr("707"), HasSubstr("units"))));
  p.shell.sections.common.thickness = Expression(200.0);
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), ElementsAre(HasSubstr("200 m thick")));
  p.shell.sections.common.thickness = Expression(100.0);
  EXPECT_THAT(warnings(p), IsEmpty());
}

TEST(Examination, notes_a_plate_so_thin_that_its_units_may_be_mixed) {
  problem::Problem p = with_chart(cantilever_plate(), {"300*x", "300*y", "0"});
  p.shell.sections.common.thickness = Expression(0.02);
  EXPECT_THAT(texts(p, Severity::note), testing::Contains(AllOf(HasSubstr("same unit"), HasSubstr("2.1e+04 times"))));
  p.shell.sections.common.thickness = Expression(2.0);
  EXPECT_THAT(texts(p, Severity::note), testing::Not(testing::Contains(HasSubstr("same unit"))));
}

TEST(Examination, finds_where_a_chart_is_not_finite) {
  EXPECT_THAT(errors(with_chart(cantilever_plate(), {"x", "y", "sqrt(0.5 - x)"})),
              ElementsAre(HasSubstr("not finite at x = 0.5")));
}

TEST(Examination, finds_where_the_chart_is_finite_but_its_derivatives_are_not) {
  EXPECT_THAT(errors(with_chart(cantilever_plate(), {"x", "y", "sqrt(x)"})),
              ElementsAre(AllOf(HasSubstr("not finite"), HasSubstr("x = 0,"))));
}

TEST(Examination, finds_a_shell_thicker_than_its_curvature_allows) {
  problem::Problem p = with_chart(cantilever_plate(), {"sin(x)", "8*y", "cos(x)"});
  p.shell.sections.common.thickness = Expression(2.0);
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("too thick for its curvature"), HasSubstr("thickness 2"),
                                           HasSubstr("curvature 1"))));
  p.shell.sections.common.thickness = Expression(1.98);
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), ElementsAre(HasSubstr("reaches 0.99")));
}

TEST(Examination, says_where_a_soft_core_leaves_its_faces_alone) {
  const auto steel = shell::Orthotropic::isotropic(1, 0.3);
  for (const auto& [modulus, is_soft] : {std::pair(0.1, false), std::pair(1e-3, false), std::pair(1e-6, true)}) {
    const auto foam = shell::Orthotropic::isotropic(modulus, 0.3);
    problem::Problem p = cantilever_plate();
    p.shell.sections.common.thickness = geometry::Expression(0.05);
    p.shell.sections.common.material = {
        .law = std::make_shared<const shell::Laminate>(
            std::vector{shell::Layer{.material = steel}, shell::Layer{.material = foam, .part = 8},
                        shell::Layer{.material = steel}},
            Eigen::Vector3d::UnitX()),
        .shear_correction = 5.0 / 6};
    const auto found = texts(p, Severity::warning);
    if (is_soft) {
      EXPECT_THAT(found, ElementsAre(HasSubstr("one director does not describe this section")));
    } else {
      EXPECT_THAT(found, IsEmpty()) << modulus;
    }
  }
}

TEST(Examination, finds_where_the_direction_of_a_material_is_normal_to_the_shell) {
  const shell::Orthotropic wood{.E1 = 10, .E2 = 1, .nu12 = 0.3, .G12 = 1, .G13 = 1, .G23 = 0.1};
  problem::Problem p = cantilever_plate();
  const auto with_direction = [&](const Eigen::Vector3d& direction) {
    p.shell.sections.common.material.law =
        std::make_shared<const shell::Laminate>(std::vector{shell::Layer{.material = wood}}, direction);
    return p;
  };
  EXPECT_FALSE(has_errors(examine(with_direction({0.3, 0, 1}))));
  EXPECT_THAT(errors(with_direction({0, 0, 1})),
              ElementsAre(HasSubstr("the material's direction is normal to the shell at x = ")));
}

TEST(Examination, finds_where_the_thickness_is_not_positive) {
  for (const std::string thickness : {"0.1 - 0.2*x", "0", "-1", "sqrt(0.5 - x)", "0.1*x"}) {
    problem::Problem p = cantilever_plate();
    p.shell.sections.common.thickness = Expression(thickness, {});
    EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("the thickness is "), HasSubstr("must be positive"))))
        << thickness;
  }
}

TEST(Examination, finds_a_kink_between_regions) {
  EXPECT_THAT(errors(two_regions({"x", "y", "0.5*(x - 1)"})),
              ElementsAre(AllOf(HasSubstr("kink at x = 1"), HasSubstr("26.6 degrees"))));
}

TEST(Examination, finds_a_gap_between_regions) {
  EXPECT_THAT(errors(two_regions({"x", "y", "0.25"})),
              ElementsAre(AllOf(HasSubstr("do not meet at x = 1"), HasSubstr("0.25 m apart"))));
}

TEST(Examination, finds_a_chart_with_its_normal_on_the_other_side) {
  EXPECT_THAT(errors(two_regions({"x", "-y", "0"})), SizeIs(1));
  EXPECT_THAT(errors(two_regions({"2 - x", "y", "0"})), ElementsAre(HasSubstr("kink")));
}

TEST(Examination, finds_a_region_without_a_chart) {
  problem::Problem p = two_regions({"x", "y", "0"});
  p.charts.erase("other");
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("\"other\" has no chart")));
}

// ---- names and places ----------------------------------------------------------------------------------------------

TEST(Examination, finds_boundaries_that_are_not_there) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.push_back(clamped("lfet"));
  p.shell.loads.on_edges.push_back({.boundary = "rim"});
  EXPECT_THAT(errors(p),
              ElementsAre(AllOf(HasSubstr("a support"), HasSubstr("\"lfet\""), HasSubstr("left, right, bottom, top")),
                          AllOf(HasSubstr("a load"), HasSubstr("\"rim\""))));
}

TEST(Examination, finds_probes_outside_of_the_domain) {
  problem::Problem p = cantilever_plate();
  p.probes = {{.name = "in", .at = {1, 0}}, {.name = "out", .at = {1.2, 0}}};
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("\"out\""), HasSubstr("(1.2, 0)"), HasSubstr("outside"),
                                           HasSubstr("x from 0 to 1"))));
}

TEST(Examination, finds_a_mesh_file_that_is_not_there) {
  problem::Problem p = cantilever_plate();
  p.domain = domain::MeshFile{"/no/such.msh"};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("/no/such.msh")));
}

TEST(Examination, finds_a_clamped_edge_inside_of_the_obstacle) {
  problem::Problem p = pressed_strip();
  std::get<obstacle::HalfSpace>(p.shell.obstacles.all.at(0).shape).point[2] = 0.02;
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("the boundary \"left\""),
                                           HasSubstr("inside of the obstacle at x = 0"), HasSubstr("0.01 m deep"))));
}

TEST(Examination, only_warns_of_a_free_part_inside_of_the_obstacle) {
  problem::Problem p = with_chart(pressed_strip(), {"x", "y", "0.04 - 0.1*x*(1 - x)"});
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), ElementsAre(AllOf(HasSubstr("initial gap: -0.01 m (at x = 0.5"), HasSubstr("pushed out"))));
}

/// The strip rises through a slab 0.2 m thick. The distance of the slab has a kink in its middle.
TEST(Examination, warns_where_the_free_side_of_an_obstacle_changes_within_the_shell) {
  const auto slab = std::make_shared<const geometry::SpaceFunction>("abs(Z) - 0.1", geometry::Constants{});
  const auto at_height = [&](const std::string& z) {
    problem::Problem p = with_chart(pressed_strip(), {"x", "y", z});
    p.shell.obstacles.all.at(0).shape = obstacle::DistanceField(slab);
    p.shell.obstacles.all.at(0).face = obstacle::Face::nearer;
    p.shell.supports = {clamped("left")};
    return p;
  };
  const auto both_ways = AllOf(HasSubstr("which side of the obstacle is the free one"), HasSubstr("along (0, 0, 1) at"),
                               HasSubstr("along (0, 0, -1) at"));
  EXPECT_THAT(warnings(at_height("0.2 - 0.23*x")), testing::Contains(both_ways));
  EXPECT_THAT(warnings(at_height("0.2 - 0.13*x")), testing::Not(testing::Contains(both_ways)));
  EXPECT_THAT(warnings(at_height("0.2 - 0.03*x")), IsEmpty());
}

TEST(Examination, says_that_corners_of_a_surface_were_joined) {
  problem::Problem p = pressed_strip();
  p.shell.obstacles.all.at(0).shape =
      obstacle::TriangleSurface({.points = {{0, 0, -9}, {9, 0, -9}, {0, 9, -9}, {0, 0, -1}},
                                 .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                                 .joined = 2,
                                 .joined_over = 3e-6});
  EXPECT_THAT(texts(p, Severity::note),
              testing::Contains(HasSubstr("2 corners at open sides were joined with others up to 3e-06 m away")));
}

TEST(Examination, finds_supports_that_contradict_each_other) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.push_back(
      {.boundary = "bottom", .components = {fixed(Unknown::displacement, Direction::z, Expression(0.1))}});
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("contradict"), HasSubstr("x = 0, y = 0"))));
}

TEST(Examination, finds_symmetry_on_an_edge_that_lies_in_no_plane) {
  problem::Problem p = pressed_bowl();
  p.shell.supports = {symmetry("rim"), held("rim", {Direction::z})};
  EXPECT_THAT(errors(p), testing::Contains(AllOf(HasSubstr("\"rim\" is no symmetry plane"), HasSubstr("turns"))));
}

// ---- rigid motions -------------------------------------------------------------------------------------------------

TEST(FreeRigidMotions, are_all_six_without_a_support) {
  EXPECT_THAT(errors(free_plate()), SizeIs(6));
  EXPECT_THAT(errors(free_plate()), testing::Each(HasSubstr("there is no [[support]], and a rigid motion is free")));
  EXPECT_THAT(errors(with_chart(free_plate(), {"x", "y", "x^2 - y^2"})), SizeIs(6));
}

TEST(FreeRigidMotions, about_a_hinge_is_the_rotation_about_it) {
  problem::Problem p = free_plate();
  p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z})};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("rotation about the axis (0, 1, 0)")));
}

TEST(FreeRigidMotions, on_a_knife_edge_are_four) {  // u.z = 0 along x = 0
  problem::Problem p = free_plate();
  p.shell.supports = {held("left", {Direction::z})};
  EXPECT_THAT(errors(p), testing::UnorderedElementsAre(HasSubstr("translation along (1, 0, 0)"),
                                                       HasSubstr("translation along (0, 1, 0)"),
                                                       HasSubstr("rotation about the axis (0, 0, 1)"),
                                                       HasSubstr("rotation about the axis (0, 1, 0)")));
}

TEST(FreeRigidMotions, in_the_plane_are_three) {
  problem::Problem p = free_plate();
  for (const char* b : {"left", "right", "bottom", "top"}) p.shell.supports.push_back(held(b, {Direction::z}));
  EXPECT_THAT(errors(p), testing::UnorderedElementsAre(HasSubstr("translation along (1, 0, 0)"),
                                                       HasSubstr("translation along (0, 1, 0)"),
                                                       HasSubstr("rotation about the axis (0, 0, 1)")));
}

TEST(FreeRigidMotions, of_a_quarter_with_two_symmetries_is_the_translation_along_both_planes) {
  problem::Problem p = free_plate();
  p.shell.supports = {symmetry("left"), symmetry("bottom")};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("translation along (0, 0, 1)")));
}

TEST(FreeRigidMotions, of_a_bowl_whose_rim_may_turn_is_the_rotation_about_its_axis) {
  problem::Problem p = pressed_bowl();
  p.shell.obstacles.all.clear();
  p.shell.supports = {held("rim", {Direction::z, Direction::conormal})};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("rotation about the axis (0, 0, 1)")));
}

TEST(FreeRigidMotions, that_only_the_obstacle_can_stop_are_named) {
  problem::Problem p = pressed_strip();
  p.shell.supports = {held("left", {Direction::x, Direction::y})};
  const auto only_held = [](const problem::Problem& problem) {
    auto notes = texts(problem, Severity::note);
    std::erase_if(notes, [](const std::string& text) { return !text.starts_with("only the obstacle holds"); });
    return notes;
  };
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(only_held(p), SizeIs(3));
  p.shell.supports.clear();
  EXPECT_THAT(errors(p), SizeIs(3));  // along the table and about its normal
  EXPECT_THAT(only_held(p), SizeIs(3));
}

/// Two unit squares with x = 2k + s, y = t in the regions "first" and "second", side by side in space.
problem::Problem two_squares() {
  problem::Problem p = free_plate();
  p.domain = domain::MeshFile{.path = PLASTRON_TESTS_DIR "/computation/meshes/two-squares.msh"};
  p.charts = {{"first", Chart({"x", "y", "0"}, {})}, {"second", Chart({"x - 1", "y", "0"}, {})}};
  return p;
}

TEST(FreeRigidMotions, of_a_part_that_no_support_holds_are_found_though_another_part_is_held) {
  problem::Problem p = two_squares();
  p.shell.supports = {clamped("west")};
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("part 2 of 2"), HasSubstr("\"second\""),
                                           HasSubstr("translation along (0, 0, 1)"),
                                           HasSubstr("rotation about the axis (0, 0, 1)"))));
  p.shell.supports.push_back(clamped("east"));
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(texts(p, Severity::note), testing::Contains(HasSubstr("no rigid motion is left free in any of 2 parts")));
}

TEST(FreeRigidMotions, of_joined_parts_are_those_of_one_shell) {
  problem::Problem p = two_squares();
  p.joins = {{{"seam_a", "seam_b"}}};
  p.shell.supports = {clamped("west")};
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(errors(free_plate()), SizeIs(6));
}

TEST(FreeRigidMotions, of_parts_at_a_hinge_are_those_against_each_other) {
  problem::Problem p = two_squares();
  p.joins = {{.boundaries = {"seam_a", "seam_b"}, .is_hinge = true}};
  p.shell.supports = {clamped("west")};
  const auto turns = AllOf(HasSubstr("a hinge lets"), HasSubstr("rotation about the axis (0, 1, 0) through (1, "));
  EXPECT_THAT(errors(p), ElementsAre(turns));
  p.charts.at("second") = Chart({"1", "y", "x - 2"}, {});
  EXPECT_THAT(errors(p), ElementsAre(turns));
  p.joins[0].stiffness = 1e-9;
  EXPECT_THAT(errors(p), IsEmpty());
  p.joins[0].stiffness = 0;
  p.shell.foundations = {{.regions = {"second"}, .tangential = Expression(1.0)}};
  EXPECT_THAT(errors(p), ElementsAre(turns));
  p.shell.foundations = {{.regions = {"second"}, .normal = Expression(1.0)}};
  EXPECT_THAT(errors(p), IsEmpty());
  p.shell.foundations.clear();
  p.shell.supports.push_back(held("east", {Direction::x}));
  EXPECT_THAT(errors(p), IsEmpty());
}

TEST(FreeRigidMotions, of_parts_that_only_the_obstacle_can_stop_depend_on_the_loads_of_each_part) {
  problem::Problem p = two_squares();
  for (const char* side : {"west", "east"}) p.shell.supports.push_back(held(side, {Direction::x, Direction::y}));
  p.shell.obstacles.all = {{.shape = obstacle::HalfSpace{.point = {0, 0, -1}}}};
  const auto loaded = [&](double on_first, double on_second) {
    p.shell.loads.on_areas = {force(0, 0, on_first), force(0, 0, on_second)};
    p.shell.loads.on_areas[0].regions = {"first"};
    p.shell.loads.on_areas[1].regions = {"second"};
    return p;
  };
  EXPECT_THAT(errors(loaded(-1, -1)), IsEmpty());
  EXPECT_THAT(errors(loaded(-2, 1)),
              ElementsAre(AllOf(HasSubstr("part 2 of 2"), HasSubstr("nothing stops the shell"))));
}

TEST(FreeRigidMotions, do_not_depend_on_units_of_length) {
  for (const char* scale : {"1e-4", "1e4"}) {
    const std::string s = scale;
    problem::Problem p = with_chart(free_plate(), {s + "*x", s + "*y", "0"});
    p.shell.sections.common.thickness = Expression("0.1*" + s, {});
    p.shell.supports = {held("left", {Direction::x, Direction::y, Direction::z})};
    EXPECT_THAT(errors(p), SizeIs(1)) << scale;
    p.shell.supports = {clamped("left")};
    EXPECT_THAT(errors(p), IsEmpty()) << scale;
  }
}

// ---- loads on free motions -----------------------------------------------------------------------------------------

/// The bowl, supported only against sliding. It may lift and tilt.
problem::Problem loose_bowl(const std::string& load) {
  problem::Problem p = pressed_bowl();
  p.shell.supports = {held("rim", {Direction::x, Direction::y})};
  p.shell.loads.on_areas = {force(0, 0, 0)};
  p.shell.loads.on_areas[0].force[2] = Expression(load, {});
  return p;
}

TEST(LooseShell, is_fine_where_the_loads_press_it_onto_the_obstacle) {
  for (const char* load : {"-1e-3", "-1e-3-1e-4*x", "-1e-3-2e-3*y", "-1e-300"}) {
    EXPECT_THAT(errors(loose_bowl(load)), IsEmpty()) << load;
    EXPECT_THAT(warnings(loose_bowl(load)), IsEmpty()) << load;
    EXPECT_THAT(texts(loose_bowl(load), Severity::note), testing::Contains(HasSubstr("the loads press the shell")));
  }
}

TEST(LooseShell, is_refused_where_the_loads_tip_it) {  // beyond the place where the rim's lower edge would stand
  EXPECT_THAT(errors(loose_bowl("-1e-3-1e-2*x")),
              ElementsAre(AllOf(HasSubstr("nothing stops the shell"), HasSubstr("rotation about the axis (0, 1, 0)"),
                                HasSubstr("through (0.484, 0, "))));
  EXPECT_THAT(errors(loose_bowl("-1e-3+1e-2*y")), ElementsAre(HasSubstr("rotation about the axis (1, 0, 0)")));
}

TEST(LooseShell, is_refused_where_the_loads_lift_it) {
  EXPECT_THAT(errors(loose_bowl("1e-3")), ElementsAre(HasSubstr("translation along (0, 0, 1)")));
}

// The limit: the moment of -1e-3 (1 + k x) about the rim, I k = A R.
TEST(LooseShell, is_judged_up_to_the_load_that_just_tips_it) {
  problem::Problem flat = with_chart(free_plate(), {"x", "y", "0.1"});
  flat.domain = domain::Rectangle{.from = {-1, -1}, .to = {1, 1}, .cells = {2, 2}};
  flat.shell.supports = {held("left", {Direction::x, Direction::y})};
  flat.shell.obstacles.all = {obstacle::Obstacle{}};
  flat.shell.loads.on_areas = {force(0, 0, 0)};
  const auto with_load = [&](const std::string& load) {
    flat.shell.loads.on_areas[0].force[2] = Expression(load, {});
    return flat;
  };
  EXPECT_THAT(errors(with_load("-1-2.99*x")), IsEmpty());  // I = A / 3
  EXPECT_THAT(warnings(with_load("-1-2.99*x")), IsEmpty());
  EXPECT_THAT(errors(with_load("-1-3*x")), IsEmpty());
  EXPECT_THAT(warnings(with_load("-1-3*x")),
              ElementsAre(AllOf(HasSubstr("need not be unique"), HasSubstr("axis (0, 1, 0)"))));
  EXPECT_THAT(errors(with_load("-1-3.01*x")), SizeIs(1));
}

TEST(LooseShell, is_warned_of_where_the_loads_do_no_work) {
  for (problem::Problem p : {loose_bowl("0"), loose_bowl("x^2-y^2")}) {
    EXPECT_THAT(errors(p), IsEmpty());
    EXPECT_THAT(warnings(p), ElementsAre(HasSubstr("do not press")));
  }
}

TEST(LooseShell, may_be_pressed_by_its_edges_and_by_couples) {
  problem::Problem p = loose_bowl("0");
  p.shell.loads.on_edges = {{.boundary = "rim", .force = vector(0, 0, -1), .couple = {}}};
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), IsEmpty());
  p.shell.loads.on_edges[0].couple[1] = Expression(1.0);  // works on r.y, hence on a rotation about -x
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("rotation about the axis (-1, 0, 0)")));
}

TEST(LooseShell, is_judged_alike_in_every_formulation_and_on_triangles) {
  for (const auto formulation :
       {element::Formulation::penalised, element::Formulation::mixed, element::Formulation::classical})
    for (const char* load : {"-1e-3", "-1e-3-1e-2*x"}) {
      problem::Problem p = loose_bowl(load);
      p.shell.supports[0].components.push_back(fixed(Unknown::rotation, Direction::normal));
      p.shell.tangency.formulation = formulation;
      EXPECT_THAT(errors(p), SizeIs(load == std::string("-1e-3") ? 0 : 1));
      p.discretisation.cells = mesh::Shape::triangle;
      EXPECT_THAT(errors(p), SizeIs(load == std::string("-1e-3") ? 0 : 1));
    }
}

// ---- faces ---------------------------------------------------------------------------------------------------------

/// The chart with exchanged parameters: the same surface with a_3 turned round.
problem::Problem turned(problem::Problem p) {
  auto [x, y, z] = p.charts.at("").components();
  return with_chart(std::move(p), {y, x, z},
                    {{"R", 1}, {"e", p.shell.sections.common.thickness(0, 0)}, {"clearance", 0.01}});
}

TEST(Face, that_is_the_far_one_is_an_error_that_says_where_a3_points) {
  for (problem::Problem p : {turned(pressed_bowl()), turned(pressed_strip())}) {
    EXPECT_THAT(errors(p), IsEmpty());  // the nearer face, unless one is named
    p.shell.obstacles.all.at(0).face = obstacle::Face::lower;
    EXPECT_THAT(errors(p), testing::Contains(AllOf(HasSubstr("the lower face is to touch"), HasSubstr("the far one"),
                                                   HasSubstr("a_3 = (0, 0, -1)"), HasSubstr("face = \"upper\""))));
    problem::Problem mended = p;
    mended.shell.obstacles.all.at(0).face = obstacle::Face::upper;
    EXPECT_THAT(errors(mended), IsEmpty());
  }
  problem::Problem wrong = pressed_bowl();
  wrong.shell.obstacles.all.at(0).face = obstacle::Face::upper;
  EXPECT_THAT(errors(wrong), ElementsAre(AllOf(HasSubstr("face = \"lower\""), HasSubstr("away from"))));
}

TEST(Face, that_is_near_is_described) {
  problem::Problem p = pressed_bowl();
  EXPECT_THAT(texts(p, Severity::note), testing::Contains(HasSubstr("the lower face looks at the obstacle")));
  EXPECT_THAT(texts(turned(p), Severity::note), testing::Contains(HasSubstr("the upper face looks at the obstacle")));
  p.shell.obstacles.all.at(0).face = obstacle::Face::lower;
  EXPECT_THAT(texts(p, Severity::note),
              testing::Contains(AllOf(HasSubstr("a_3 = (0, 0, 1)"), HasSubstr("the lower face is 0.02 m nearer"))));
}

TEST(Face, is_judged_only_where_the_obstacle_is_near) {  // the upper half of a tube is farther away than its thickness
  problem::Problem tube = with_chart(free_plate(), {"sin(x)", "-y", "1.1 - cos(x)"});
  tube.domain = domain::Rectangle{.from = {-3, 0}, .to = {3, 1}, .cells = {12, 2}};
  tube.shell.supports = {clamped("left"), clamped("right")};
  tube.shell.obstacles.all = {obstacle::Obstacle{.face = obstacle::Face::upper}};
  EXPECT_THAT(errors(tube), IsEmpty());
  tube.shell.obstacles.all.at(0).face = obstacle::Face::lower;
  EXPECT_THAT(errors(tube), ElementsAre(HasSubstr("face = \"upper\"")));
}

TEST(Face, of_an_upright_shell_may_be_either) {
  problem::Problem wall = with_chart(free_plate(), {"x", "0", "y + 0.01"});
  wall.shell.supports = {clamped("top")};
  for (const auto face : {obstacle::Face::lower, obstacle::Face::upper}) {
    wall.shell.obstacles.all = {obstacle::Obstacle{.face = face}};
    EXPECT_THAT(errors(wall), IsEmpty());
    EXPECT_THAT(texts(wall, Severity::note), testing::Contains(HasSubstr("about equally near")));
  }
}

TEST(Face, of_an_inclined_strip_is_the_lower_one) {
  for (const double slope : {0.3, 1.0, 1.4}) {
    problem::Problem strip = with_chart(pressed_strip(), {"x*cos(s)", "y", "0.05 + x*sin(s)"}, {{"s", slope}});
    EXPECT_THAT(errors(strip), IsEmpty()) << slope;
    strip.shell.obstacles.all.at(0).face = obstacle::Face::upper;
    EXPECT_THAT(errors(strip), SizeIs(1)) << slope;
  }
}

TEST(InitialGap, that_is_negative_everywhere_asks_for_a_reversed_normal) {
  problem::Problem p = pressed_strip();
  std::get<obstacle::HalfSpace>(p.shell.obstacles.all.at(0).shape).normal = {0, 0, -1};
  p.shell.obstacles.all.at(0).face = obstacle::Face::upper;
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("inside of the obstacle"), HasSubstr("is a normal reversed"))));
  problem::Problem lifted = pressed_strip();  // by its supports, out of the obstacle
  std::get<obstacle::HalfSpace>(lifted.shell.obstacles.all.at(0).shape).point[2] = 0.02;
  for (Support& s : lifted.shell.supports)
    for (auto& c : s.components)
      if (c.unknown == Unknown::displacement && c.direction == Direction::z) c.value = Expression(0.03);
  EXPECT_THAT(errors(lifted), IsEmpty());
  EXPECT_THAT(warnings(lifted), ElementsAre(AllOf(HasSubstr("initial gap: -0.01"), HasSubstr("is a normal reversed"))));
}

TEST(Examination, warns_where_nodes_may_miss_a_small_obstacle) {
  problem::Problem p = pressed_strip();  // nodes are 1/32 apart
  const auto roller = [](double radius) {
    return obstacle::Obstacle{
        .name = "roller",
        .shape = obstacle::Cylinder{.point = {0.51, 0, -radius}, .axis = {0, 1, 0}, .radius = radius}};
  };
  p.shell.obstacles.all = {roller(0.01)};
  EXPECT_THAT(warnings(p), ElementsAre(AllOf(HasSubstr("all nodes may miss it"), HasSubstr("radius 0.01 m"))));
  p.shell.obstacles.all = {roller(0.02)};
  EXPECT_THAT(warnings(p), IsEmpty());
  p.shell.obstacles.all = {roller(0.01)};
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-3}}};
  EXPECT_THAT(warnings(p), IsEmpty());
}

// ---- units ---------------------------------------------------------------------------------------------------------

std::string times(const std::string& scale, const std::string& text) { return scale + "*(" + text + ")"; }

/// All lengths in space in another unit; the parameters too if they are lengths.
problem::Problem in_units(const problem::Problem& p, const std::string& scale,
                          const std::array<std::string, 3>& chart) {
  problem::Problem q = with_chart(p, {times(scale, chart[0]), times(scale, chart[1]), times(scale, chart[2])});
  const double s = std::stod(scale);
  q.shell.sections.common.thickness = Expression(s * p.shell.sections.common.thickness(0, 0));
  if (!q.shell.obstacles.empty()) std::get<obstacle::HalfSpace>(q.shell.obstacles.all.at(0).shape).point *= s;
  return q;
}

std::vector<Severity> severities(const problem::Problem& p) {
  std::vector<Severity> all;
  for (const Finding& f : examine(p)) all.push_back(f.severity);
  return all;
}

TEST(Units, of_length_change_no_finding) {
  const std::array<std::string, 3> bowl{"x", "y", "0.02 + 1 - sqrt(1 - x^2 - y^2)"}, strip{"x", "y", "0.035"};
  const std::array<std::string, 3> inside{"x", "y", "0.035 - 1e-4*x*(1-x)"};
  const std::array<std::string, 3> deep{"x", "y", "0.02"};
  problem::Problem loose = pressed_strip();
  loose.shell.supports = {held("left", {Direction::x, Direction::y})};
  for (const char* scale : {"1e-12", "1e-6", "1e6"}) {
    for (const auto& [problem, chart] :
         std::vector<std::pair<problem::Problem, std::array<std::string, 3>>>{{pressed_bowl(), bowl},
                                                                              {turned(pressed_bowl()), bowl},
                                                                              {pressed_strip(), strip},
                                                                              {pressed_strip(), inside},
                                                                              {pressed_strip(), deep},
                                                                              {loose, strip}})
      EXPECT_EQ(severities(in_units(problem, scale, chart)), severities(in_units(problem, "1", chart)))
          << scale << " " << chart[2];
  }
}

TEST(Units, of_length_hide_no_jump_between_regions) {
  for (const std::string s : {"1e-9", "1e9"}) {
    problem::Problem p = two_regions({s + "*x", s + "*y", s + "*1e-4"});
    p.charts.erase("flat");
    p.charts.emplace("flat", Chart({s + "*x", s + "*y", "0*x"}, {}));
    p.shell.sections.common.thickness = Expression(0.1 * std::stod(s));
    EXPECT_THAT(errors(p), ElementsAre(HasSubstr("do not meet at x = 1"))) << s;
  }
}

TEST(Units, of_length_hide_no_support_inside_of_the_obstacle) {
  for (const double s : {1e-12, 1e-6, 1e6}) {
    problem::Problem p = in_units(pressed_strip(), std::to_string(1), {"x", "y", "0.035"});
    p = with_chart(p, {fmt::format("{}*x", s), fmt::format("{}*y", s), fmt::format("{}*(0.025 - 1e-9)", s)});
    p.shell.sections.common.thickness = Expression(0.05 * s);
    EXPECT_THAT(errors(p), ElementsAre(HasSubstr("inside of the obstacle"))) << s;
    p = with_chart(p, {fmt::format("{}*x", s), fmt::format("{}*y", s), fmt::format("{}*0.025", s)});
    EXPECT_THAT(errors(p), IsEmpty()) << s;
  }
}

/// A part of a tube of radius 1 on a floor under its weight, supported along its axis and at its lowest point. `half` = 3.14159... is the whole tube.
problem::Problem tube_on_floor(double half) {
  problem::Problem p = with_chart(cantilever_plate(), {"sin(x)", "y", "1 + e/2 - cos(x)"}, {{"e", 0.02}});
  p.domain = domain::Rectangle{.from = {-half, 0}, .to = {half, 1}, .cells = {8, 2}};
  p.shell.sections.common.thickness = Expression(0.02);
  if (half > 3) p.joins = {{{"left", "right"}}};
  p.shell.supports = {held("bottom", {assembly::Direction::y}),
                      {.components = {fixed(assembly::Unknown::displacement, assembly::Direction::x)},
                       .point = Eigen::Vector2d(0, 0.5)}};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  return p;
}

TEST(Examination, tells_that_a_pipe_can_roll_and_a_cradle_cannot) {
  EXPECT_THAT(errors(tube_on_floor(M_PI)), IsEmpty());
  EXPECT_THAT(warnings(tube_on_floor(M_PI)),
              testing::Contains(AllOf(HasSubstr("can roll"), HasSubstr("axis (0, 1, 0)"))));
  EXPECT_THAT(errors(tube_on_floor(1)), IsEmpty());
  EXPECT_THAT(warnings(tube_on_floor(1)), testing::Not(testing::Contains(HasSubstr("can roll"))));
}

// The forces of initial strains turn with the shell. They were taken for loads, which keep their directions.
TEST(Examination, does_not_take_initial_strains_for_loads_that_let_a_plate_roll) {
  for (const double strain : {-1e-3, 1e-3, 0.1}) {
    problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "0"}, {});
    const auto material = shell::Orthotropic::isotropic(7e4, 0.3);
    p.shell.sections.common.thickness = Expression(0.02);
    p.shell.sections.common.material.law = std::make_shared<const shell::Laminate>(
        std::vector{shell::Layer{.material = material, .strain = {strain, strain, 0}},
                    shell::Layer{.material = material}},
        Eigen::Vector3d(1, 0, 0));
    p.shell.supports = {{.components = {fixed(assembly::Unknown::displacement, assembly::Direction::x),
                                        fixed(assembly::Unknown::displacement, assembly::Direction::y)},
                         .point = Eigen::Vector2d(0, 0)},
                        {.components = {fixed(assembly::Unknown::displacement, assembly::Direction::y)},
                         .point = Eigen::Vector2d(1, 0)}};
    p.shell.loads.on_areas = {force(0, 0, -2e-5)};
    p.shell.obstacles.all = {{.name = "table", .shape = obstacle::HalfSpace{.point = {0, 0, -0.01}}}};
    EXPECT_THAT(errors(p), IsEmpty()) << strain;
    EXPECT_THAT(warnings(p), testing::Not(testing::Contains(HasSubstr("can roll")))) << strain;
  }
}

}  // namespace
}  // namespace plastron::examination
