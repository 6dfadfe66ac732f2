// The differences between the formulations: interpolation of covariant components (M15), the form on r . a_3 (M13), the
// multiplier (M14).
#include "assembly/sample_shells.hpp"

#include <plastron/assembly/box_problem.hpp>
#include <plastron/energy/normal_rotation.hpp>

#include <gtest/gtest.h>

#include <random>

#include "algebra/allocations.hpp"
#include "algebra/assertions_are_live.hpp"

namespace plastron::assembly {
namespace {

algebra::Vector random_field(const fem::Space& space, int block, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  algebra::Vector y(space.layout, block);
  for (double& v : y.local()) v = uniform(random);
  return y;
}

std::unique_ptr<DiscreteShell> shell_of(const test::MeshedSurface& m, const element::Tangency& tangency) {
  return discretise(m.space, m.surface,
                    {.sections = test::steel_of(geometry::Expression("0.1 + 0.02*x", {})),
                     .tangency = tangency,
                     .supports = {test::clamp("edge1")}});
}

TEST(Formulation, ForcesAreTheTransposeOfStrainsInEachOfThem) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  for (const auto formulation : {element::Formulation::tangent, element::Formulation::penalised,
                                 element::Formulation::mixed, element::Formulation::classical}) {
    const auto discrete = shell_of(m, {.formulation = formulation});
    const energy::ShellOperator& shell = discrete->shell;
    const element::CellField v = shell.gather(1, random_field(*m.space, 6, 1));
    energy::CellStrain s = energy::CellStrain::Random(shell.tables().points_per_cell(), 8);
    const double left = shell.strains(1, v).cwiseProduct(s).sum();
    EXPECT_NEAR(left, shell.forces(1, s).cwiseProduct(v).sum(), 1e-12 * std::abs(left));
    const Eigen::VectorXd from_matrix = shell.strain_matrix(1) * Eigen::Map<const Eigen::VectorXd>(v.data(), v.size());
    const energy::CellStrain direct = shell.strains(1, v);
    EXPECT_NEAR((from_matrix - Eigen::Map<const Eigen::VectorXd>(direct.data(), direct.size())).norm(), 0, 1e-12);
  }
}

/// Largest difference at the middle of a side between the rigid motion and its interpolant.
double interpolation_error(int refinements) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, refinements);
  const auto discrete = shell_of(m, {.formulation = element::Formulation::classical});
  const Vector3d c(0.3, -0.2, 0.5), w(0.1, 0.7, -0.4);
  const algebra::Vector y = test::rigid_motion(*m.space, discrete->points, c, w);
  const element::BasisAt at = element::basis_at(mesh::Shape::quadrilateral, 2, {{0.3, 0.6}});
  double worst = 0;
  for (std::size_t cell = 0; cell < m.space->owned_cells; ++cell) {
    const geometry::Frame frame = m.surface->frame(m.space->cells[cell], at.xi[0], false);
    const element::CellField value = discrete->shell.interpolation().values(cell, at, discrete->shell.gather(cell, y));
    worst = std::max({worst, (value.row(0).head<3>().transpose() - c - w.cross(frame.phi)).norm(),
                      (value.row(0).tail<3>().transpose() - w.cross(frame.a3)).norm()});
    EXPECT_NEAR(value.row(0).tail<3>().dot(frame.a3), 0, 1e-14);  // tangent everywhere, not only at nodes
  }
  return algebra::max_over_ranks(worst, MPI_COMM_WORLD);
}

TEST(Formulation, CovariantInterpolationIsTangentEverywhereAndConvergesLikeHToTheDegreePlusOne) {
  const double coarse = interpolation_error(1), fine = interpolation_error(2);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 3, 0.4);
}

TEST(Formulation, OnAFlatShellTheClassicalOneIsTheTangentOne) {
  const auto m = test::meshed(test::skew(), test::flat, 2, 1);
  const auto tangent = shell_of(m, {}), classical = shell_of(m, {.formulation = element::Formulation::classical});
  algebra::Vector y = random_field(*m.space, 6, 3);
  for (std::size_t i = 0; i < y.local().size(); i += 6) y.local()[i + 5] = 0;
  algebra::Vector f(m.space->layout, 6), g = f;
  y.update_ghosts();
  tangent->apply(y, f);
  classical->apply(y, g);
  for (std::size_t i = 0; i < f.owned().size(); ++i)
    if (i % 6 != 5) {
      EXPECT_NEAR(f.owned()[i], g.owned()[i], 1e-13);
    }
}

TEST(Formulation, TheTangencyFormIsThatOfTheNormalComponentAlone) {
  const auto m = test::meshed(test::skew(), test::saddle, 3, 1);
  const auto discrete = shell_of(m, {.formulation = element::Formulation::penalised, .penalty = 0.25});
  ASSERT_EQ(discrete->terms.size(), 1u);
  EXPECT_TRUE(discrete->terms.front()->is_artificial());
  // r = a_3 has r . a_3 = 1, so only its interpolation error has a gradient. r = x a_3 has the gradient of x.
  const auto energy_of = [&](auto magnitude) {
    algebra::Vector y(m.space->layout, 6);
    for (std::size_t i = 0; i < discrete->points.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        y.local()[6 * i + 3 + k] = magnitude(discrete->points[i]) * discrete->points[i].a3[static_cast<int>(k)];
    return discrete->energy_of_terms(y, true);
  };
  const double constant = energy_of([](const NodalPoint&) { return 1.0; });
  const double linear = energy_of([](const NodalPoint& p) { return p.x[0]; });
  EXPECT_LT(constant, 1e-5 * linear);
  // 1/2 factor int E e^3 a^{11} sqrt(a) dx by the quadrature of the cells; a^{11} of z = h(x, y) is (1 + h_y^2) / a.
  double expected = 0;
  for (std::size_t c = 0; c < m.space->owned_cells; ++c) {
    const auto& xi = discrete->shell.tables().quadrature.xi;
    std::vector<double> x(xi.size()), y(xi.size());
    m.surface->positions(m.space->cells[c], xi, x, y);
    for (std::size_t q = 0; q < xi.size(); ++q) {
      const double hx = 0.6 * x[q] + 0.1 * y[q], hy = -0.6 * y[q] + 0.1 * x[q], e = 0.1 + 0.02 * x[q];
      expected +=
          2 * e * e * e * (1 + hy * hy) / (1 + hx * hx + hy * hy) * discrete->shell.point(c, static_cast<int>(q)).area;
    }
  }
  EXPECT_NEAR(linear, algebra::sum_over_ranks(expected, MPI_COMM_WORLD), 1e-4 * linear);
}

TEST(Formulation, OperatorsAreAppliedWithoutNewVectors) {
  if (test::assertions_are_live) GTEST_SKIP() << "assertions compare with a vector of their own";
  const auto m = test::meshed(test::skew(), test::saddle, 2, 3);
  for (const auto formulation :
       {element::Formulation::tangent, element::Formulation::penalised, element::Formulation::mixed}) {
    const auto discrete = shell_of(m, {.formulation = formulation});
    const algebra::Matrix matrix = stiffness_matrix(*discrete);
    const contact::BoxProblem problem = box_problem(*discrete, matrix);
    const algebra::Vector z = random_field(*m.space, discrete->coordinates.width, 5), q = random_field(*m.space, 1, 6);
    algebra::Vector Az = z, Bz = q;
    const auto apply = [&] {
      problem.apply(z, Az);
      if (!problem.equations) return;
      problem.equations->apply(z, Bz);
      problem.equations->apply_transposed(q, Az);
    };
    apply();
    const test::Allocations allocations;
    apply();
    EXPECT_LT(allocations.largest_bytes(), q.local().size_bytes());
  }
}

TEST(Formulation, TheTangencyFormHasOneOperatorOneEnergyAndOneMatrix) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 0);
  const auto discrete = shell_of(m, {.formulation = element::Formulation::penalised});
  algebra::Vector y = random_field(*m.space, 6, 5), f(m.space->layout, 6);
  y.update_ghosts();
  add_normal_rotation_form(discrete->shell, 3, y, f);
  f.accumulate_ghosts();
  const double energy = tangency_energy(discrete->shell, 3, y);
  EXPECT_NEAR(algebra::dot(y, f) / 2, energy, 1e-12 * energy);
  double from_matrix = 0;
  for (std::size_t c = 0; c < m.space->owned_cells; ++c) {
    const element::CellField v = discrete->shell.gather(c, y);
    from_matrix +=
        (scaled_normal_rotation_matrix(discrete->shell, c, 3) * Eigen::Map<const Eigen::VectorXd>(v.data(), v.size()))
            .squaredNorm() /
        2;
  }
  EXPECT_NEAR(algebra::sum_over_ranks(from_matrix, MPI_COMM_WORLD), energy, 1e-12 * energy);
}

TEST(Formulation, TheCouplingAndItsTransposeAreOneForm) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  const auto discrete = shell_of(m, {.formulation = element::Formulation::mixed});
  algebra::Vector y = random_field(*m.space, 6, 7), q = random_field(*m.space, 1, 8);
  y.update_ghosts();
  q.update_ghosts();
  algebra::Vector By(m.space->layout, 1), Bq(m.space->layout, 6);
  apply_coupling(discrete->shell, y, By);
  apply_coupling_transposed(discrete->shell, q, Bq);
  const double value = algebra::dot(By, q);
  EXPECT_NEAR(value, algebra::dot(y, Bq), 1e-12 * std::abs(value));
  // b((0, q a_3), q) is the gradient form of q up to the interpolation of q a_3.
  for (std::size_t i = 0; i < discrete->points.size(); ++i) {
    const double x = discrete->points[i].x[0];
    q.local()[i] = x * x;
    for (std::size_t k = 0; k < 6; ++k)
      y.local()[6 * i + k] = k < 3 ? 0 : x * x * discrete->points[i].a3[static_cast<int>(k) - 3];
  }
  apply_coupling(discrete->shell, y, By);
  const double norm = gradient_norm(discrete->shell, q);
  EXPECT_NEAR(algebra::dot(By, q), norm * norm, 2e-3 * norm * norm);
  algebra::Vector Kq(m.space->layout, 1);
  gradient_matrix(discrete->shell).multiply(q, Kq);
  EXPECT_NEAR(algebra::dot(Kq, q), norm * norm, 1e-12 * norm * norm);
}

TEST(Formulation, TheMultiplierVanishesWhereASupportHoldsARotation) {
  const auto m = test::meshed(test::skew(), test::saddle, 2, 1);
  const auto discrete = shell_of(m, {.formulation = element::Formulation::mixed});
  const auto zeros = multiplier_zeros(discrete->coordinates, *m.space->layout);
  std::int64_t count = 0;
  for (const char zero : zeros) count += zero;
  EXPECT_EQ(algebra::sum_over_ranks(count, MPI_COMM_WORLD), 5);  // the nodes of one clamped edge
}

}  // namespace
}  // namespace plastron::assembly
