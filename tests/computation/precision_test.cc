// The thinnest shell for double precision: the estimate against the findings of the certificate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/checks.hpp>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// The strip of cases/inclined-strip. All displacements have one size, whatever the thickness. Lengths are in metres times
/// `unit`.
problem::Problem bent_strip(double e, double unit = 1) {
  problem::Problem p =
      with_chart(pressed_strip(), {"unit*x*cos(0.3)", "unit*y", "unit*(0.01 + x*sin(0.3) + e/2*cos(0.3))"},
                 {{"unit", unit}, {"e", e}});
  p.shell.sections.common.thickness = Expression(e * unit);
  p.shell.loads.on_areas = {force(0, 0, -20 * e * e * e)};
  p.discretisation.degree = 3;
  p.discretisation.refinements = 1;
  return p;
}

std::vector<std::string> warnings(const problem::Problem& problem) {
  std::vector<std::string> all;
  for (const examination::Finding& f : examination::examine(problem))
    if (f.severity == examination::Severity::warning) all.push_back(f.text);
  return all;
}

TEST(RoundingResidual, is_what_the_certificate_finds_within_an_order) {
  for (const double e : {1e-5, 1e-6}) {
    const problem::Problem p = bent_strip(e);
    const double ratio = solve(p, MPI_COMM_SELF).certificate.energy_identity / examination::rounding_residual(p);
    EXPECT_GT(ratio, 0.05) << e;  // the certificate refers to the work of the loads, which exceeds the energy
    EXPECT_LT(ratio, 10) << e;
  }
}

TEST(RoundingResidual, is_warned_of_where_the_certificate_would_refuse) {
  EXPECT_THAT(warnings(bent_strip(1e-3)), IsEmpty());
  EXPECT_THAT(warnings(bent_strip(1e-6)), Contains(HasSubstr("very thin for double precision")));
}

TEST(RoundingResidual, does_not_depend_on_the_unit_of_length) {
  const double residual = examination::rounding_residual(bent_strip(1e-4));
  for (const double unit : {1e-12, 1e-6, 1e6})
    EXPECT_NEAR(examination::rounding_residual(bent_strip(1e-4, unit)) / residual, 1, 1e-6);
}

}  // namespace
}  // namespace plastron::computation
