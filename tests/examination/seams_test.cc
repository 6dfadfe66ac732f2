// The examination names seams: edges of the domain that the chart brings together without a join.
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

std::vector<std::string> seams(const problem::Problem& problem) {
  std::vector<std::string> all;
  for (const std::string& text : warnings(problem))
    if (text.find("seam") != std::string::npos) all.push_back(text);
  return all;
}

/// A sheet of `turns` turns of a cylinder of radius `radius`; its lower end is clamped.
problem::Problem rolled(double turns, double radius, mesh::Shape cells = mesh::Shape::quadrilateral) {
  const Constants constants{{"R", radius}, {"w", 2 * 3.14159265358979323846}};
  problem::Problem p = cantilever_plate();
  p.domain = domain::Rectangle{.to = {turns, 1}};
  p.charts.clear();
  p.charts.emplace("", Chart({"R*sin(w*x)", "R*y", "R*cos(w*x)"}, constants));
  p.shell.sections.common.thickness = Expression(0.01 * radius);
  p.shell.supports = {clamped("bottom")};
  p.discretisation.cells = cells;
  return p;
}

TEST(Seams, of_a_slit_tube_are_named_in_every_unit_of_length) {
  for (const double radius : {1e-9, 1e-3, 1.0, 1e6})
    for (const auto cells : {mesh::Shape::quadrilateral, mesh::Shape::triangle})
      EXPECT_THAT(seams(rolled(1, radius, cells)),
                  ElementsAre(AllOf(HasSubstr("\"left\" at x = 0"), HasSubstr("\"right\" at x = 1"))))
          << radius;
}

TEST(Seams, are_not_seen_where_there_are_none) {
  EXPECT_THAT(seams(rolled(0.5, 1)), IsEmpty());
  EXPECT_THAT(seams(rolled(0.999, 1)), IsEmpty());
  EXPECT_THAT(seams(cantilever_plate()), IsEmpty());
}

}  // namespace
}  // namespace plastron::examination
