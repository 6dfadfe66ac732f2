// Inf-sup constants of b (M14) and c (M19) and soft modes, against dense matrices from the forms themselves.
#include "assembly/sample_shells.hpp"

#include <plastron/energy/normal_rotation.hpp>
#include <research/spectra/field_norms.hpp>
#include <research/spectra/spectra.hpp>

#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace plastron::spectra {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::dense;

std::vector<Index> free_unknowns(const assembly::DiscreteShell& discrete) {
  std::vector<Index> free;
  for (std::size_t i = 0; i < discrete.coordinates.lower.owned().size(); ++i)
    if (discrete.coordinates.lower.owned()[i] != discrete.coordinates.upper.owned()[i])
      free.push_back(static_cast<Index>(i));
  return free;
}

/// sqrt of the smallest eigenvalue of  G x = beta^2 N x.
double smallest_root(const MatrixXd& G, const MatrixXd& N) {
  return std::sqrt(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(G, N).eigenvalues()[0]);
}

assembly::RigidObstacles table() {
  return {.all = {{.shape = obstacle::HalfSpace{{0, 0, -1}, Vector3d(0.2, 0.1, 1).normalized()}}}};
}

std::unique_ptr<assembly::DiscreteShell> clamped_shell(const std::array<std::string, 3>& chart,
                                                       element::Formulation formulation, bool with_gap) {
  const auto m = test::meshed(test::skew(), chart, 2, 1);
  return assembly::discretise(m.space, m.surface,
                              {.sections = test::steel_of(geometry::Expression(0.1)),
                               .tangency = {.formulation = formulation},
                               .supports = {test::clamp("edge1"), test::clamp("edge2")},
                               .obstacles = with_gap ? table() : assembly::RigidObstacles{}});
}

constexpr double length = 0.7;  // L of the norms

TEST(H1Matrix, GivesTheSquaredNormOfAField) {
  for (const auto formulation :
       {element::Formulation::tangent, element::Formulation::mixed, element::Formulation::classical}) {
    const auto discrete = clamped_shell(test::flat, formulation, true);
    const algebra::Matrix X = h1_matrix(discrete->shell, discrete->coordinates, length);
    algebra::Vector z(X.layout(), X.block()), Xz(z), y(X.layout(), 6);
    for (std::size_t i = 0; i < z.local().size(); ++i) z.local()[i] = std::sin(3.0 * static_cast<double>(i));
    X.multiply(z, Xz);
    discrete->coordinates.to_cartesian(z, y);
    const double expected =
        squared_norms(discrete->shell, y).h1(length);  // of Cartesian interpolation; the same on a flat shell
    EXPECT_NEAR(algebra::dot(z, Xz), expected, 1e-12 * expected);
  }
}

TEST(InfSup, OfBIsThatOfDenseMatrices) {
  const auto discrete = clamped_shell(test::saddle, element::Formulation::mixed, false);
  const auto free = free_unknowns(*discrete);
  const auto& layout = discrete->space().layout;
  const auto zeros = multiplier_zeros(discrete->coordinates, *layout);
  std::vector<Index> multipliers;
  for (std::size_t i = 0; i < zeros.size(); ++i)
    if (!zeros[i]) multipliers.push_back(static_cast<Index>(i));
  const MatrixXd X = dense(h1_matrix(discrete->shell, discrete->coordinates, length))(free, free);
  const MatrixXd K = dense(gradient_matrix(discrete->shell))(multipliers, multipliers);
  MatrixXd Bt(6 * layout->owned, layout->owned);
  for (Index j = 0; j < Bt.cols(); ++j) {
    algebra::Vector q(layout, 1), f(layout, 6), z(layout, 6);
    q.local()[static_cast<std::size_t>(j)] = 1;
    apply_coupling_transposed(discrete->shell, q, f);
    discrete->coordinates.add_transposed(f, z);
    Bt.col(j) = Eigen::Map<const VectorXd>(z.owned().data(), Bt.rows());
  }
  const MatrixXd B = Bt(free, multipliers);
  const double expected = smallest_root(B.transpose() * X.llt().solve(B), K);
  const auto found = tangency_inf_sup(*discrete, length);
  ASSERT_TRUE(found);
  EXPECT_GT(expected, 0.1);
  EXPECT_NEAR(*found, expected, 1e-6 * expected);
}

TEST(InfSup, OfBIsNoneWithoutAHeldRotation) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  const auto discrete =
      assembly::discretise(m.space, m.surface, {.tangency = {.formulation = element::Formulation::mixed}});
  EXPECT_FALSE(tangency_inf_sup(*discrete, length));
}

TEST(InfSup, OfCIsThatOfDenseMatrices) {
  for (const auto formulation : {element::Formulation::tangent, element::Formulation::mixed}) {
    const auto discrete = clamped_shell(test::saddle, formulation, true);
    const auto free = free_unknowns(*discrete);
    const int width = discrete->coordinates.width;
    const Index nodes = discrete->space().layout->owned;
    std::vector<Index> multipliers;
    MatrixXd Ct = MatrixXd::Zero(width * nodes, nodes);  // column i: weight_i n_i . (v + z s), without r . a_3
    for (Index i = 0; i < nodes; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const obstacle::Gap& gap = discrete->coordinates.gaps[0][k];
      const Vector3d& a3 = discrete->points[k].a3;
      Eigen::Matrix<double, 6, 1> row;
      row << gap.normal, gap.z * (gap.normal - gap.normal.dot(a3) * a3);
      Ct.block(width * i, i, width, 1) =
          discrete->points[k].weight * discrete->coordinates.basis[k].leftCols(width).transpose() * row;
      if (!discrete->coordinates.is_prescribed(k, 0)) multipliers.push_back(i);
    }
    ASSERT_LT(multipliers.size(), static_cast<std::size_t>(nodes));
    const MatrixXd C = Ct(free, multipliers);
    const MatrixXd X = dense(h1_matrix(discrete->shell, discrete->coordinates, length))(free, free);
    const MatrixXd K = dense(scalar_h1_matrix(discrete->shell, length))(multipliers, multipliers);
    VectorXd weights(static_cast<Index>(multipliers.size()));
    for (Index i = 0; i < weights.size(); ++i)
      weights[i] = discrete->points[static_cast<std::size_t>(multipliers[static_cast<std::size_t>(i)])].weight;
    const MatrixXd W = weights.asDiagonal();
    const MatrixXd G = C.transpose() * X.llt().solve(C);
    const auto found = contact_inf_sup(*discrete, length);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->multipliers, weights.size());
    const double dual = smallest_root(G, W * K.llt().solve(W)), l2 = smallest_root(G, std::pow(length, 4) * W);
    EXPECT_NEAR(found->dual, dual, 1e-6 * dual);
    EXPECT_NEAR(found->l2, l2, 1e-5 * l2);
  }
}

// v = w n and s = 0 has the gap w and the norm of w. So the constant is at least one, for every mesh, thickness and shape.
TEST(InfSup, OfCIsAtLeastOneAgainstAPlane) {
  for (const auto& chart : {test::flat, test::saddle, test::cap})
    EXPECT_GT(contact_inf_sup(*clamped_shell(chart, element::Formulation::tangent, true), length)->dual, 1 - 1e-9);
}

TEST(SoftModes, StartWithTheConstantOfCoercivity) {
  for (const auto formulation :
       {element::Formulation::tangent, element::Formulation::penalised, element::Formulation::classical}) {
    const auto discrete = clamped_shell(test::cap, formulation, false);
    const auto free = free_unknowns(*discrete);
    const MatrixXd A = dense(assembly::stiffness_matrix(*discrete))(free, free);
    const MatrixXd X = dense(h1_matrix(discrete->shell, discrete->coordinates, length))(free, free);
    const VectorXd expected = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, X).eigenvalues();
    const auto modes = softest_modes(*discrete, 3, length);
    ASSERT_EQ(modes.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(modes[k].stiffness, expected[static_cast<Index>(k)], 1e-7 * expected[static_cast<Index>(k)]);
  }
}

/// Kinds of the modes that are softer than a hundredth of the eighth.
std::vector<ModeKind> soft_kinds(const std::array<std::string, 3>& chart, element::Formulation formulation) {
  const auto m = test::meshed(test::skew(), chart, 3, 2);
  const auto discrete = assembly::discretise(
      m.space, m.surface,
      {.sections = test::steel_of(geometry::Expression(0.1)), .tangency = {.formulation = formulation}});
  const auto modes = softest_modes(*discrete, 8, 1);
  std::vector<ModeKind> kinds;
  for (const Mode& mode : modes)
    if (mode.stiffness < 0.01 * modes.back().stiffness) kinds.push_back(mode.kind());
  std::ranges::sort(kinds);
  return kinds;
}

constexpr std::array rigid{ModeKind::translation, ModeKind::translation, ModeKind::translation,
                           ModeKind::rotation,    ModeKind::rotation,    ModeKind::rotation};
const std::array<std::string, 3> cylinder{"sin(x)", "y", "-cos(x)"};

TEST(SoftModes, AreSevenOnDevelopableSurfacesInRelaxedFormulations) {
  std::vector expected(rigid.begin(), rigid.end());
  expected.push_back(ModeKind::normal_rotation);
  for (const auto& chart : {test::flat, cylinder})
    for (const auto formulation : {element::Formulation::penalised, element::Formulation::mixed})
      EXPECT_EQ(soft_kinds(chart, formulation), expected);
}

TEST(SoftModes, AreTheSixRigidMotionsOtherwise) {
  const std::vector expected(rigid.begin(), rigid.end());
  for (const auto formulation : {element::Formulation::tangent, element::Formulation::classical})
    EXPECT_EQ(soft_kinds(cylinder, formulation), expected);
  EXPECT_EQ(soft_kinds(test::saddle, element::Formulation::penalised), expected);
}

}  // namespace
}  // namespace plastron::spectra
