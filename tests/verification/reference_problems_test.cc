// The builders of the reference problems: their charts, obstacles and coordinates match the stored numbers.
#include "verification/reference_problems.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace plastron::verification {

namespace {

obstacle::Gap gap_of(const problem::Problem& problem, double x, double y) {
  const geometry::SurfaceJet phi = problem.charts.at("")(x, y);
  return obstacle::gap_at(problem.shell.obstacles.all.at(0),
                          {phi.value, geometry::unit_normal(phi), problem.shell.sections.common.thickness(x, y)});
}

}  // namespace

TEST(ReferenceProblems, AreElevenContactProblemsWithTitlesOfTheirOwn) {
  std::set<std::string> titles;
  for (const auto& name : contact_reference_names()) titles.insert(contact_reference_title(name));
  EXPECT_EQ(titles.size(), 11u);
}

TEST(ReferenceProblems, HaveTheGapsOfTheirRows) {
  for (const auto& name : contact_reference_names()) {
    const ContactReference reference = contact_reference(name, 2, 3);
    SCOPED_TRACE(name);
    ASSERT_FALSE(reference.rows.empty());
    for (const auto& row : reference.rows) {
      const Eigen::Vector3d u(row.u_x, 0, row.u_z), r(row.r_x, 0, row.r_z);
      const auto at = row.at;
      EXPECT_NEAR(gap_of(reference.problem, at, 0)(u, r), row.gap, 1e-12) << "at " << at;
      const auto phi = reference.problem.charts.at("")(at, 0);
      EXPECT_NEAR(r.dot(geometry::unit_normal(phi)), 0, 1e-12) << "at " << at;
      EXPECT_GE(row.gap, -1e-12);
      EXPECT_GE(row.eta, 0);
    }
  }
}

TEST(ReferenceProblems, HaveTheirContactBoundariesAmongTheirRows) {
  for (const auto& name : contact_reference_names()) {
    const ContactReference reference = contact_reference(name, 2, 3);
    EXPECT_EQ(reference.boundaries.size() + 1, reference.pattern.size()) << name;
    for (const double boundary : reference.boundaries)
      EXPECT_TRUE(std::ranges::any_of(reference.rows, [&](const auto& row) {
        return row.touching && std::abs(row.at - boundary) < 1e-12;
      })) << name;
  }
}

TEST(ReferenceProblems, HaveTheStripInClosedFormAsTheyHaveItFromTheirSolver) {
  for (const double e : {0.1, 0.01}) {
    const ContactReference strip = pressed_strip(e, 2, 3);
    const ContactReference stored = contact_reference(strip.name, 2, 3);
    EXPECT_NEAR(strip.energy / stored.energy, 1, 1e-11) << e;
    EXPECT_NEAR(strip.load_work / stored.load_work, 1, 1e-11) << e;
    EXPECT_NEAR(strip.reaction / stored.reaction, 1, 1e-11) << e;
    EXPECT_NEAR(strip.boundaries.front(), stored.boundaries.front(), 1e-11) << e;
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    EXPECT_NEAR(gap_of(strip.problem, 0, 0)(none, none), gap_of(stored.problem, 0, 0)(none, none), 1e-15) << e;
    const auto load = [](const problem::Problem& problem) {
      return problem.shell.loads.on_areas.front().force[2](0, 0);
    };
    EXPECT_NEAR(load(strip.problem) / load(stored.problem), 1, 1e-14) << e;
  }
}

TEST(ReferenceProblems, NameBoundariesOfTheirDomains) {
  std::vector<problem::Problem> problems;
  for (const auto& name : contact_reference_names()) problems.push_back(contact_reference(name, 2, 3).problem);
  for (const auto k : {ShearCorrection::one, ShearCorrection::five_sixths}) {
    for (const bool half : {false, true}) problems.push_back(hyperbolic_paraboloid(0.01, k, half, 2, 3).problem);
    for (const bool hard : {false, true}) problems.push_back(scordelis_lo(k, hard, 2, 3).problem);
    problems.push_back(free_hyperboloid(0.01, k, 2, 3).problem);
    problems.push_back(clamped_plate(0.1, k, 2, 3).problem);
  }
  for (const auto& problem : problems) {
    const auto names = domain::boundary_names(problem.domain);
    for (const auto& support : problem.shell.supports) EXPECT_TRUE(std::ranges::count(names, support.boundary) == 1);
  }
}

TEST(ReferenceProblems, ManufacturedProblemsHaveTheirExactGapsAndLoads) {
  const Manufactured exact(ManufacturedSolution::contact, {.thickness = 0.3});
  const problem::Problem problem = manufactured_problem(exact, 2, 3);
  const double x = 0.2, y = 0.3;
  EXPECT_NEAR(gap_of(problem, x, y)(exact.u(x, y).value, exact.r(x, y).value), exact.gap(x, y), 1e-15);
  EXPECT_EQ(problem.shell.loads.on_areas.at(0).force_function(x, y), exact.force(x, y));
  EXPECT_EQ(problem.shell.loads.on_areas.at(0).couple_function(x, y), exact.couple(x, y));
  EXPECT_TRUE(manufactured_problem({ManufacturedSolution::clamped, {}}, 2, 3).shell.obstacles.empty());
}

TEST(ReferenceProblems, RefuseAThicknessWithoutReference) {
  EXPECT_THROW(clamped_plate(0.05, ShearCorrection::one, 2, 3), std::invalid_argument);
}

TEST(ReferenceProblems, TheHyperboloidsNormalPointsAwayFromItsAxis) {
  const auto reference = free_hyperboloid(0.1, ShearCorrection::one, 2, 3);
  const auto phi = reference.problem.charts.at("")(0.3, 0.4);
  EXPECT_GT(geometry::unit_normal(phi).head<2>().dot(phi.value.head<2>()), 0);
}

}  // namespace plastron::verification
