// The soft modes of a shell without supports: three translations, three rotations, and no seventh.
#include "assembly/sample_shells.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <plastron/domain/domain.hpp>

#include <cmath>

namespace plastron::spectra {
namespace {

/// Ascending eigenvalues of the stiffness in nodal coordinates without supports, relative to the largest.
Eigen::VectorXd spectrum(const domain::Domain& domain, const std::array<std::string, 3>& chart,
                         const test::Element& element, int refinements) {
  const auto [shape, degree, tying] = element;
  const auto m = test::meshed(domain, chart, degree, refinements, shape);
  const auto discrete =
      assembly::discretise(m.space, m.surface, {.sections = test::steel_of(geometry::Expression(0.1)), .tying = tying});
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                     test::dense(assembly::stiffness_matrix(*discrete)), Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  return values / values.maxCoeff();
}

class FreeShell : public testing::TestWithParam<test::Element> {};
INSTANTIATE_TEST_SUITE_P(Quadrilaterals, FreeShell,
                         testing::Combine(testing::Values(test::quadrilateral), testing::Values(1, 2, 3, 4),
                                          testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Triangles, FreeShell,
                         testing::Combine(testing::Values(test::triangle), testing::Values(1, 2),
                                          testing::Values(false)));

TEST_P(FreeShell, AFlatShellHasSixZeroModesAndNoSeventh) {
  const Eigen::VectorXd s = spectrum(test::skew(), test::flat, GetParam(), 1);
  EXPECT_LT(std::abs(s[5]), 1e-13);
  EXPECT_GT(s[6], 1e-8);
}

TEST_P(FreeShell, ACurvedShellHasThreeZeroModesThreeRotationsAndNoSeventh) {
  const int degree = std::get<1>(GetParam());
  const bool tying = std::get<2>(GetParam());
  for (const auto& chart : {test::saddle, test::cap}) {
    const Eigen::VectorXd coarse = spectrum(test::skew(), chart, GetParam(), 1),
                          fine = spectrum(test::skew(), chart, GetParam(), 2);
    EXPECT_LT(std::abs(fine[2]), 1e-13) << "translations";
    EXPECT_GT(fine[6], 1e-8) << "no seventh soft mode";
    // The rotations: energy O(h^2k). Eigenvalues are relative to one that grows like h^0 in energy per nodal value,
    // while a rotation's nodal values grow in number like h^-2, so the ratio falls at least as fast as the energy.
    if (fine[5] > 1e-13) {
      EXPECT_GT(std::log2(coarse[5] / fine[5]), 2 * degree - 0.5) << chart[2];
      // Elements of degree 1 without tying are too coarse here to distinguish a rotation from a bending mode by its size.
      if (degree > 1 || tying) {
        EXPECT_LT(fine[5], 0.05 * fine[6]);
      }
    }
  }
}

}  // namespace
}  // namespace plastron::spectra
