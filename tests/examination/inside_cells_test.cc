// Kinks and jumps between the sample points of an examination are found, with their places.
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

problem::Problem on(mesh::Shape shape, problem::Problem p) {
  p.discretisation.cells = shape;
  return p;
}
constexpr auto both_shapes = {mesh::Shape::quadrilateral, mesh::Shape::triangle};

problem::Problem with_thickness(const std::string& e) {
  problem::Problem p = cantilever_plate();
  p.shell.sections.common.thickness = Expression(e, {});
  return p;
}
problem::Problem with_pressure(const std::string& pressure) {
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas[0].pressure = Expression(pressure, {});
  return p;
}

// ---- chart ---------------------------------------------------------------------------------------------------------

TEST(InsideACell, a_kink_of_the_chart_is_an_error) {
  for (const mesh::Shape shape : both_shapes)
    for (const char* z : {"abs(x - 0.3)", "0.001*abs(x - 0.3)", "x^2 + 0.01*abs(x + 2*y - 0.9)", "abs(y - 0.77)"})
      EXPECT_THAT(
          errors(on(shape, with_chart(cantilever_plate(), {"x", "y", z}))),
          testing::Contains(AllOf(HasSubstr("has a kink"), HasSubstr("near x = "), HasSubstr("round the fold"))))
          << z;
  EXPECT_THAT(errors(with_chart(cantilever_plate(), {"x", "y", "abs(x - 0.3)"})),
              testing::Contains(HasSubstr("near x = 0.3, ")));
}

TEST(InsideACell, a_kink_on_a_mesh_line_is_an_error_too) {
  EXPECT_THAT(errors(with_chart(cantilever_plate(), {"x", "y", "abs(x - 0.5)"})),
              ElementsAre(AllOf(HasSubstr("kink at x = 0.5"), HasSubstr("both sides"))));
}

TEST(InsideACell, a_kink_on_a_line_of_meshes_finer_than_the_sample_is_an_error_too) {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "abs(x - 33/128)"});
  p.discretisation.refinements = 6;
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("has a kink")));
}

TEST(InsideACell, a_jump_of_the_curvature_is_a_warning_with_a_remedy) {
  for (const mesh::Shape shape : both_shapes) {
    const problem::Problem p = on(shape, with_chart(cantilever_plate(), {"x", "y", "(x - 0.3)*abs(x - 0.3)/2"}));
    EXPECT_THAT(errors(p), IsEmpty());
    EXPECT_THAT(warnings(p), ElementsAre(AllOf(HasSubstr("curvature"), HasSubstr("near x = 0.3, "),
                                               HasSubstr("by 2 1/m"), HasSubstr("breaks"))));
  }
}

TEST(InsideACell, a_jump_of_the_curvature_on_a_mesh_line_is_nothing) {
  problem::Problem p = with_chart(cantilever_plate(), {"x", "y", "(x - 0.3)*abs(x - 0.3)/2"});
  p.domain = domain::Rectangle{.cells = {2, 2}, .breaks = {0.3}, .regions = {"left", "right"}};
  p.charts = {{"left", p.charts.at("")}, {"right", p.charts.at("")}};
  EXPECT_THAT(errors(p), IsEmpty());
  EXPECT_THAT(warnings(p), IsEmpty());
}

TEST(InsideACell, a_fold_that_is_rounded_off_is_no_kink) {
  for (const char* z :
       {"sqrt((x - 0.3)^2 + 1e-2)", "0.05*tanh(50*(x - 0.3))", "sin(20*x)*0.1", "exp(-200*(x-0.4)^2)"}) {
    problem::Problem p = with_chart(cantilever_plate(), {"x", "y", z});
    p.shell.sections.common.thickness = Expression(1e-3);
    EXPECT_THAT(errors(p), IsEmpty()) << z;
    EXPECT_THAT(warnings(p), IsEmpty()) << z;
  }
}

// ---- thickness -----------------------------------------------------------------------------------------------------

TEST(InsideACell, a_jump_of_the_thickness_is_an_error) {
  for (const mesh::Shape shape : both_shapes)
    EXPECT_THAT(errors(on(shape, with_thickness("x < 0.3 ? 0.1 : 0.12"))),
                ElementsAre(AllOf(HasSubstr("the thickness \"x < 0.3"), HasSubstr("near x = 0.3, "),
                                  HasSubstr("by 0.02 m"), HasSubstr("breaks"))));
}

TEST(InsideACell, a_slit_of_another_thickness_is_an_error_however_narrow_beside_the_cells) {
  for (const mesh::Shape shape : both_shapes)
    EXPECT_THAT(errors(on(shape, with_thickness("abs(x - 0.3115) < 0.0015 ? 0.05 : 0.1"))),
                ElementsAre(AllOf(HasSubstr("jumps inside of a cell near x = 0.31"), HasSubstr("by 0.05 m"))));
}

TEST(InsideACell, a_jump_of_the_thickness_on_a_line_of_the_finest_mesh_is_nothing) {
  problem::Problem p = with_thickness("x < 0.25 ? 0.1 : 0.12");  // two cells along x, refined once
  EXPECT_THAT(errors(p), IsEmpty());
  p.discretisation.refinements = 0;
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("jumps inside of a cell")));
}

TEST(InsideACell, a_thickness_that_only_bends_is_nothing) {
  for (const char* e : {"0.1 + 0.1*abs(x - 0.3)", "max(0.1, 0.2*x)", "0.1 + 0.01*sqrt(abs(y - 0.3))", "0.1*exp(x)"})
    EXPECT_THAT(errors(with_thickness(e)), IsEmpty()) << e;
}

// ---- loads ---------------------------------------------------------------------------------------------------------

TEST(InsideACell, a_jump_of_a_load_is_noted) {
  EXPECT_THAT(
      texts(with_pressure("x < 0.3 ? 1 : 0"), Severity::note),
      testing::Contains(AllOf(HasSubstr("a load's pressure"), HasSubstr("near x = 0.3, "), HasSubstr("divided"))));
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_edges = {{.boundary = "right"}};
  p.shell.loads.on_edges[0].force[2] = Expression("sign(y - 0.7)", {});
  EXPECT_THAT(texts(p, Severity::note),
              testing::Contains(AllOf(HasSubstr("z component of a load's force on the boundary \"right\""),
                                      HasSubstr("near x = 1, y = 0.7"))));
  EXPECT_THAT(errors(p), IsEmpty());
}

TEST(Load, that_is_not_finite_is_an_error_with_its_place_and_its_key) {
  EXPECT_THAT(errors(with_pressure("1/x")),
              ElementsAre(AllOf(HasSubstr("a load's pressure, \"1/x\", is inf"), HasSubstr("at x = 0, y = "),
                                HasSubstr("must be finite"))));
  EXPECT_THAT(errors(with_pressure("log(x - 0.5)")), ElementsAre(HasSubstr("nan at x = ")));
  problem::Problem p = cantilever_plate();
  p.shell.loads.on_areas[0].couple[1] = Expression("sqrt(y - 0.99)", {});
  p.shell.loads.on_edges = {{.boundary = "right"}};
  p.shell.loads.on_edges[0].force[0] = Expression("log(-y)", {});
  EXPECT_THAT(errors(p), ElementsAre(HasSubstr("the y component of a load's couple"),
                                     AllOf(HasSubstr("the x component of a load's force"), HasSubstr("\"right\""))));
}

TEST(Support, that_prescribes_no_finite_value_is_an_error_with_its_place_and_its_key) {
  problem::Problem p = cantilever_plate();
  p.shell.supports.push_back(held("right", {Direction::z}));
  p.shell.supports[1].components[0].value = Expression("1/y", {});
  EXPECT_THAT(errors(p),
              testing::Contains(AllOf(HasSubstr("the value of u.z on the boundary \"right\", \"1/y\", is inf"),
                                      HasSubstr("at x = 1, y = 0"))));
}

TEST(Thickness, that_is_infinite_is_an_error) {
  EXPECT_THAT(errors(with_thickness("0.1/x")), ElementsAre(HasSubstr("the thickness is inf")));
}

}  // namespace
}  // namespace plastron::examination
