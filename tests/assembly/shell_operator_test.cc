#include "assembly/sample_shells.hpp"

#include <gtest/gtest.h>
#include <algebra/assertions_are_live.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace plastron::assembly {
namespace {

energy::ShellOperator make(const std::array<std::string, 3>& chart, const test::Element& element, int refinements) {
  const auto [shape, degree, tying] = element;
  const auto m = test::meshed(test::skew(), chart, degree, refinements, shape);
  return {m.space, m.surface, test::steel_of(geometry::Expression("0.1 + 0.02*x", {})), tying, false};
}

algebra::Vector random_field(const fem::Space& space, int seed) {
  algebra::Vector y(space.layout, 6);
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& v : y.owned()) v = uniform(generator);
  y.update_ghosts();
  return y;
}

class EveryElement : public testing::TestWithParam<test::Element> {};
INSTANTIATE_TEST_SUITE_P(Quadrilaterals, EveryElement,
                         testing::Combine(testing::Values(test::quadrilateral), testing::Values(1, 2, 3, 4, 6),
                                          testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Triangles, EveryElement,
                         testing::Combine(testing::Values(test::triangle), testing::Values(1, 2),
                                          testing::Values(false)));

TEST_P(EveryElement, TheStrainMatrixTimesAFieldIsItsStrain) {
  const energy::ShellOperator shell = make(test::saddle, GetParam(), 1);
  const algebra::Vector y = random_field(shell.space(), 1);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const element::CellField field = shell.gather(c, y);
    const energy::CellStrain strains = shell.strains(c, field);
    const Eigen::VectorXd product =
        shell.strain_matrix(c) * Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
    const Eigen::Map<const Eigen::VectorXd> flat(strains.data(), strains.size());
    EXPECT_LT((product - flat).cwiseAbs().maxCoeff(), 1e-12 * flat.cwiseAbs().maxCoeff());
  }
}

TEST_P(EveryElement, ForcesAreTheTransposeOfStrains) {
  const energy::ShellOperator shell = make(test::saddle, GetParam(), 0);
  const element::CellField v = shell.gather(0, random_field(shell.space(), 2));
  const energy::CellStrain e = shell.strains(0, v);
  energy::CellStrain s = energy::CellStrain::Random(e.rows(), 8);
  const double through_strains = (s.array() * e.array()).sum(),
               through_forces = (shell.forces(0, s).array() * v.array()).sum();
  EXPECT_NEAR(through_strains, through_forces, 1e-11 * std::abs(s.norm() * e.norm()));
}

TEST_P(EveryElement, TheStiffnessMatrixMakesTheEnergy) {
  const auto [shape, degree, tying] = GetParam();
  const auto m = test::meshed(test::skew(), test::saddle, degree, 0, shape);
  const auto discrete = discretise(
      m.space, m.surface, {.sections = test::steel_of(geometry::Expression("0.1 + 0.02*x", {})), .tying = tying});
  algebra::Vector z(m.space->layout, discrete->coordinates.width), Az(z), y(m.space->layout, 6);
  std::ranges::copy(random_field(*m.space, 3).local().first(z.local().size()), z.local().begin());
  z.update_ghosts();
  stiffness_matrix(*discrete).multiply(z, Az);
  discrete->coordinates.to_cartesian(z, y);
  const double energy = discrete->shell.energies(y).total();
  EXPECT_NEAR(algebra::dot(z, Az) / 2, energy, 1e-11 * energy);
}

TEST_P(EveryElement, ApplyIsTheDerivativeOfTheEnergy) {
  const energy::ShellOperator shell = make(test::saddle, GetParam(), 1);
  const algebra::Vector y = random_field(shell.space(), 4);
  algebra::Vector f(shell.space().layout, 6);
  shell.apply(y, f);
  // The energy is quadratic: E(y) = 1/2 f(y) . y.
  const double energy = shell.energies(y).total();
  EXPECT_NEAR(algebra::dot(f, y) / 2, energy, 1e-11 * energy);
}

TEST_P(EveryElement, ATranslationHasNoStrainAtAll) {
  for (const auto& chart : {test::flat, test::saddle, test::cap}) {
    const energy::ShellOperator shell = make(chart, GetParam(), 1);
    const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
    const auto y = test::rigid_motion(shell.space(), points, {1, -2, 0.5}, {0, 0, 0});
    EXPECT_LT(shell.energies(y).total(), 1e-25);
  }
}

TEST_P(EveryElement, ARotationOfAFlatShellHasNoStrain) {
  const energy::ShellOperator shell = make(test::flat, GetParam(), 1);
  const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
  const auto y = test::rigid_motion(shell.space(), points, {0, 0, 0}, {0.3, -0.4, 0.7});
  EXPECT_LT(shell.energies(y).total(), 1e-25);
}

// phi and a_3 are no polynomials, so a rotation is only interpolated: strain O(h^k), energy O(h^2k).
TEST_P(EveryElement, TheEnergyOfARotationFallsLikeTheMeshSizeToTheTwiceDegree) {
  const int degree = std::get<1>(GetParam());
  if (degree > 4) return;
  for (const auto& chart : {test::saddle, test::cap}) {
    double energy[2];
    for (int i = 0; i < 2; ++i) {
      const energy::ShellOperator shell = make(chart, GetParam(), i + 2);
      const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
      energy[i] = shell.energies(test::rigid_motion(shell.space(), points, {0, 0, 0}, {0.3, -0.4, 0.7})).total();
    }
    EXPECT_GT(std::log2(energy[0] / energy[1]), 2 * degree - 0.3) << chart[2];
  }
}

TEST(ShellOperator, TheRateOfARotationsEnergyIsAtMostWhatTheInterpolationGives) {
  double energy[2];
  for (int i = 0; i < 2; ++i) {
    const energy::ShellOperator shell = make(test::cap, {test::quadrilateral, 1, true}, i + 3);
    const auto points = nodal_geometry(shell.space(), shell.surface(), shell.tables(), shell.sections());
    energy[i] = shell.energies(test::rigid_motion(shell.space(), points, {0, 0, 0}, {0.3, -0.4, 0.7})).total();
  }
  EXPECT_GT(energy[1], 1e-14);
}

TEST(ShellOperatorDeathTest, TakesFieldsOfSixValuesANodeAndCellsThatAreThere) {
  if (test::cannot_watch_a_program_die()) GTEST_SKIP() << "assertions are off, or several ranks";
  const energy::ShellOperator shell = make(test::flat, {test::quadrilateral, 2, true}, 0);
  const algebra::Vector five(shell.space().layout, 5), six(shell.space().layout, 6);
  EXPECT_DEATH(shell.gather(0, five), "y.block\\(\\) == 6.* = gathered, 5, 45, 9");
  EXPECT_DEATH(shell.gather(1, six), "cell < cells.size\\(\\); cell, cells.size\\(\\) = 1, 1");
  EXPECT_DEATH(shell.strains(0, element::CellField::Zero(4, 6)), "= 4, 9");
}

}  // namespace
}  // namespace plastron::assembly
