// The warning that a mesh without tying is too coarse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/computation/warnings.hpp>
#include <plastron/examination/examine.hpp>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A cantilever of side 1 with 2^(refinements + 1) cells along it.
problem::Problem cantilever(mesh::Shape cells, int degree, double thickness, int refinements, bool tying = false) {
  problem::Problem p = cantilever_plate();
  p.shell.sections.common.thickness = Expression(thickness);
  p.discretisation = {.cells = cells, .degree = degree, .refinements = refinements};
  p.shell.tying = tying;
  return p;
}

constexpr auto triangle = mesh::Shape::triangle, quadrilateral = mesh::Shape::quadrilateral;

TEST(LockingWarning, names_the_sides_in_thicknesses_and_the_remedy) {
  EXPECT_THAT(locking_warnings(cantilever(triangle, 1, 0.01, 3)),
              ElementsAre(AllOf(HasSubstr("triangles of degree 1"), HasSubstr("6.25 times the thickness"),
                                HasSubstr("cells = \"quadrilateral\""), HasSubstr("degree 2"),
                                HasSubstr("refine 4 more times"))));
  EXPECT_THAT(locking_warnings(cantilever(quadrilateral, 1, 0.01, 3)), ElementsAre(HasSubstr("set tying = true")));
}

TEST(LockingWarning, ends_when_the_mesh_is_refined_as_it_says) {
  EXPECT_THAT(locking_warnings(cantilever(triangle, 1, 0.01, 7)), IsEmpty());
  EXPECT_THAT(locking_warnings(cantilever(triangle, 2, 0.001, 2)), ElementsAre(HasSubstr("2 more times")));
  EXPECT_THAT(locking_warnings(cantilever(triangle, 2, 0.001, 4)), IsEmpty());
}

TEST(LockingWarning, is_not_given_for_tied_thick_or_high_order_elements) {
  EXPECT_THAT(locking_warnings(cantilever(quadrilateral, 1, 1e-4, 0, true)), IsEmpty());
  EXPECT_THAT(locking_warnings(cantilever(triangle, 1, 0.5, 2)), IsEmpty());
  EXPECT_THAT(locking_warnings(cantilever(quadrilateral, 5, 1e-3, 1)), IsEmpty());
}

TEST(LockingWarning, comes_with_the_result_and_with_the_examination) {
  const problem::Problem p = cantilever(triangle, 1, 0.01, 1);
  const auto expected = locking_warnings(p);
  ASSERT_EQ(expected.size(), 1u);
  EXPECT_THAT(solve(p, MPI_COMM_SELF).warnings, testing::Contains(expected.front()));
  const auto findings = examination::examine(p);
  EXPECT_NE(std::ranges::find(findings, expected.front(), &examination::Finding::text), findings.end());
}

}  // namespace
}  // namespace plastron::computation
