// The examination finds what is wrong, where it is wrong, and nothing in good problems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/study/examine.hpp>

#include "study/problems.hpp"

namespace plastron::study {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> texts(const Problem& problem, Severity severity) {
  std::vector<std::string> all;
  for (const Finding& f : examine(problem))
    if (f.severity == severity) all.push_back(f.text);
  return all;
}

std::vector<std::string> errors(const Problem& problem) { return texts(problem, Severity::error); }
std::vector<std::string> warnings(const Problem& problem) { return texts(problem, Severity::warning); }

Problem two_regions(const std::array<std::string, 3>& second) {
  Problem p = cantilever_plate();
  p.domain = fem::Rectangle{.to = {2, 1}, .cells = {2, 1}, .breaks = {1}, .regions = {"flat", "other"}};
  p.charts.clear();
  p.charts.emplace("flat", Chart({"x", "y", "0"}, {}));
  p.charts.emplace("other", Chart(second, {}));
  return p;
}

// ---- good problems -------------------------------------------------------------------------------------------------

std::vector<Problem> good_problems() {
  std::vector<Problem> all{cantilever_plate(), pressed_strip(), pressed_bowl(),
                           two_regions({"1 + sin(x - 1)", "y", "1 - cos(x - 1)"})};
  all.push_back(with_chart(cantilever_plate(), {"2*sin(x/2)", "y", "2*cos(x/2)"}));
  all.push_back(with_chart(cantilever_plate(), {"x", "y", "x^2 - y^2"}));
  Problem quarter = free_plate();
  quarter.supports = {symmetry("left"), symmetry("bottom"), held("right", {Direction::z})};
  all.push_back(quarter);
  Problem quarter_cylinder = with_chart(free_plate(), {"sin(x)", "y", "cos(x)"});
  quarter_cylinder.supports = {symmetry("left"), symmetry("bottom"), clamped("top")};
  all.push_back(quarter_cylinder);
  Problem probed = cantilever_plate();
  probed.probes = {{.name = "corner", .at = {1, 1}}, {.name = "middle", .at = {0.5, 0.5}}};
  all.push_back(probed);
  Problem polygon = cantilever_plate();
  polygon.domain = fem::Polygon{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  polygon.supports = {clamped("edge6")};
  all.push_back(polygon);
  return all;
}

TEST(GoodProblem, is_only_described) {
  for (const Problem& p : good_problems()) {
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
  Problem polar = with_chart(cantilever_plate(), {"x*cos(y)", "x*sin(y)", "0"});
  polar.supports = {clamped("right")};
  EXPECT_THAT(errors(polar), ElementsAre(AllOf(HasSubstr("degenerate"), HasSubstr("x = 0,"))));
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
  Problem p = with_chart(cantilever_plate(), {"sin(x)", "y", "cos(x)"});
  p.thickness = Expression(2.0);
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("too thick for its curvature"), HasSubstr("thickness 2"),
                                           HasSubstr("curvature 1"))));
  p.thickness = Expression(1.98);
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), ElementsAre(HasSubstr("reaches 0.99")));
}

TEST(Examination, finds_where_the_thickness_is_not_positive) {
  for (const std::string thickness : {"0.1 - 0.2*x", "0", "-1", "sqrt(0.5 - x)", "0.1*x"}) {
    Problem p = cantilever_plate();
    p.thickness = Expression(thickness, {});
    EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("the thickness is "), HasSubstr("must be positive"))))
        << thickness;
  }
}

TEST(Examination, finds_a_kink_between_regions) {
  EXPECT_THAT(errors(two_regions({"x", "y", "0.5*(x - 1)"})),
              ElementsAre(AllOf(HasSubstr("kink at x = 1"), HasSubstr("rad"))));
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
  Problem p = two_regions({"x", "y", "0"});
  p.charts.erase("other");
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("\"other\" has no chart")));
}

// ---- names and places ----------------------------------------------------------------------------------------------

TEST(Examination, finds_boundaries_that_are_not_there) {
  Problem p = cantilever_plate();
  p.supports.push_back(clamped("lfet"));
  p.edge_loads.push_back({.boundary = "rim"});
  EXPECT_THAT(errors(p),
              ElementsAre(AllOf(HasSubstr("a support"), HasSubstr("\"lfet\""), HasSubstr("left, right, bottom, top")),
                          AllOf(HasSubstr("a load"), HasSubstr("\"rim\""))));
}

TEST(Examination, finds_probes_outside_of_the_domain) {
  Problem p = cantilever_plate();
  p.probes = {{.name = "in", .at = {1, 0}}, {.name = "out", .at = {1.2, 0}}};
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("\"out\""), HasSubstr("(1.2, 0)"), HasSubstr("outside"))));
}

TEST(Examination, finds_a_mesh_file_that_is_not_there) {
  Problem p = cantilever_plate();
  p.domain = fem::MeshFile{"/no/such.msh"};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("/no/such.msh")));
}

TEST(Examination, finds_a_clamped_edge_inside_of_the_obstacle) {
  Problem p = pressed_strip();
  p.obstacle->half_space.point[2] = 0.02;
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("the boundary \"left\""),
                                           HasSubstr("inside of the obstacle at x = 0"), HasSubstr("0.01 m deep"))));
}

TEST(Examination, only_warns_of_a_free_part_inside_of_the_obstacle) {
  Problem p = with_chart(pressed_strip(), {"x", "y", "0.04 - 0.1*x*(1 - x)"});
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), ElementsAre(AllOf(HasSubstr("initial gap: -0.01 m (at x = 0.5"), HasSubstr("pushed out"))));
}

TEST(Examination, finds_supports_that_contradict_each_other) {
  Problem p = cantilever_plate();
  p.supports.push_back(
      {.boundary = "bottom", .components = {fixed(Unknown::displacement, Direction::z, Expression(0.1))}});
  EXPECT_THAT(errors(p), ElementsAre(AllOf(HasSubstr("contradict"), HasSubstr("x = 0, y = 0"))));
}

TEST(Examination, finds_symmetry_on_an_edge_that_lies_in_no_plane) {
  Problem p = pressed_bowl();
  p.supports = {symmetry("rim"), held("rim", {Direction::z})};
  EXPECT_THAT(errors(p), testing::Contains(AllOf(HasSubstr("\"rim\" is no symmetry plane"), HasSubstr("turns"))));
}

// ---- rigid motions -------------------------------------------------------------------------------------------------

TEST(FreeRigidMotions, are_all_six_without_a_support) {
  EXPECT_THAT(errors(free_plate()), SizeIs(6));
  EXPECT_THAT(errors(free_plate()), testing::Each(HasSubstr("rigid motion free")));
  EXPECT_THAT(errors(with_chart(free_plate(), {"x", "y", "x^2 - y^2"})), SizeIs(6));
}

TEST(FreeRigidMotions, about_a_hinge_is_the_rotation_about_it) {
  Problem p = free_plate();
  p.supports = {held("left", {Direction::x, Direction::y, Direction::z})};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("rotation about the axis (0, 1, 0)")));
}

TEST(FreeRigidMotions, on_a_knife_edge_are_four) {  // u.z = 0 along x = 0
  Problem p = free_plate();
  p.supports = {held("left", {Direction::z})};
  EXPECT_THAT(errors(p), testing::UnorderedElementsAre(HasSubstr("translation along (1, 0, 0)"),
                                                       HasSubstr("translation along (0, 1, 0)"),
                                                       HasSubstr("rotation about the axis (0, 0, 1)"),
                                                       HasSubstr("rotation about the axis (0, 1, 0)")));
}

TEST(FreeRigidMotions, in_the_plane_are_three) {
  Problem p = free_plate();
  for (const char* b : {"left", "right", "bottom", "top"}) p.supports.push_back(held(b, {Direction::z}));
  EXPECT_THAT(errors(p), testing::UnorderedElementsAre(HasSubstr("translation along (1, 0, 0)"),
                                                       HasSubstr("translation along (0, 1, 0)"),
                                                       HasSubstr("rotation about the axis (0, 0, 1)")));
}

TEST(FreeRigidMotions, of_a_quarter_with_two_symmetries_is_the_translation_along_both_planes) {
  Problem p = free_plate();
  p.supports = {symmetry("left"), symmetry("bottom")};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("translation along (0, 0, 1)")));
}

TEST(FreeRigidMotions, of_a_bowl_whose_rim_may_turn_is_the_rotation_about_its_axis) {
  Problem p = pressed_bowl();
  p.obstacle.reset();
  p.supports = {held("rim", {Direction::z, Direction::conormal})};
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("rotation about the axis (0, 0, 1)")));
}

TEST(FreeRigidMotions, that_only_the_obstacle_can_stop_are_warnings) {
  Problem p = pressed_strip();
  p.supports = {held("left", {Direction::x, Direction::y})};
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), SizeIs(3));
  EXPECT_THAT(warnings(p), testing::Each(HasSubstr("only the obstacle can hold")));
  p.supports.clear();
  EXPECT_THAT(errors(p), SizeIs(3));  // along the table and about its normal
  EXPECT_THAT(warnings(p), SizeIs(3));
}

TEST(FreeRigidMotions, do_not_depend_on_units_of_length) {
  for (const char* scale : {"1e-4", "1e4"}) {
    const std::string s = scale;
    Problem p = with_chart(free_plate(), {s + "*x", s + "*y", "0"});
    p.thickness = Expression("0.1*" + s, {});
    p.supports = {held("left", {Direction::x, Direction::y, Direction::z})};
    EXPECT_THAT(errors(p), SizeIs(1)) << scale;
    p.supports = {clamped("left")};
    EXPECT_THAT(errors(p), IsEmpty()) << scale;
  }
}

}  // namespace
}  // namespace plastron::study
