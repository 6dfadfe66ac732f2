// Loops over packs of cells against the plain form, cell by cell: for every instruction set of the machine, and for
// numbers of cells that do not fill a whole pack.
#include "assembly/sample_shells.hpp"

#include <plastron/domain/domain.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/shell/strain.hpp>

#include <gtest/gtest.h>
#include <larger.hpp>

#include <random>

namespace plastron::assembly {
namespace {

algebra::Vector random_values(const fem::Space& space, int block, unsigned seed) {
  std::mt19937 random(seed + static_cast<unsigned>(space.layout->first));
  std::uniform_real_distribution<double> uniform(-1, 1);
  algebra::Vector y(space.layout, block);
  for (double& v : y.owned()) v = uniform(random);
  y.update_ghosts();
  return y;
}

/// Largest difference of owned values, relative to the largest value.
double relative_difference(const algebra::Vector& a, const algebra::Vector& b) {
  algebra::Vector difference = a;
  algebra::axpy(-1, b, difference);
  return algebra::max_abs(difference) / algebra::max_abs(b);
}

/// 17 or 68 cells: no pack of 2, 4 or 8 divides these numbers. Distributed over ranks they give odd numbers too.
test::MeshedSurface strip_of(mesh::Shape shape, int degree) {
  const int refinements = degree <= 2 ? 1 : 0;
  const domain::Rectangle strip{.from = {0, 0}, .to = {2, 0.3}, .cells = {17, 1}};
  return test::meshed(strip, test::saddle, degree, refinements, shape);
}

energy::ShellOperator shell_on(const test::MeshedSurface& m, bool tying, const energy::PackKernels& kernels) {
  return {m.space, m.surface, test::steel_of(geometry::Expression("0.1 + 0.02*x", {})), tying, false, kernels};
}

/// Adds the nodal forces of `stresses`: the transpose of normal_rotation_gradients().
void add_normal_rotation_forces(const energy::ShellOperator& shell, std::size_t cell,
                                const energy::CellGradient& stresses, element::CellField& forces) {
  element::FieldRows dual = element::FieldRows::zero(stresses.rows());
  for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
    shell::LocalField<double> at_point = shell::zero_field();
    shell::add_normal_rotation_dual(stresses.row(q), shell.frame_at(cell, q), at_point);
    dual.add_dual(q, at_point);
  }
  shell.interpolation().add_forces(cell, shell.tables().quadrature, shell.quadrature_bases(cell), std::move(dual),
                                   forces);
}

/// One region of a laminate that couples membrane and bending; steel in the others.
energy::ShellOperator laminate_on(const test::MeshedSurface& m, bool tying, const energy::PackKernels& kernels) {
  const shell::Orthotropic carbon{.E1 = 25, .E2 = 1, .nu12 = 0.25, .G12 = 0.5, .G13 = 0.5, .G23 = 0.2};
  const std::vector<shell::Layer> layers{{.material = carbon, .angle = 0.5},
                                         {.material = carbon, .part = 2, .angle = -1}};
  energy::CrossSections sections = test::steel_of(geometry::Expression("0.1 + 0.02*x", {}));
  sections.common.material.law = std::make_shared<const shell::Laminate>(layers, Eigen::Vector3d(1, 0.5, 0));
  return {m.space, m.surface, sections, tying, false, kernels};
}

class EveryPack : public testing::TestWithParam<test::Element> {
 protected:
  /// Calls test(shell) for all instruction sets.
  template <class Test>
  void on_all(const Test& test) const {
    const auto [shape, degree, tying] = GetParam();
    const auto m = strip_of(shape, degree);
    ASSERT_FALSE(energy::pack_kernels().empty());
    for (const energy::PackKernels* kernels : energy::pack_kernels()) {
      SCOPED_TRACE(kernels->name);
      test(shell_on(m, tying, *kernels));
      SCOPED_TRACE("laminate");
      test(laminate_on(m, tying, *kernels));
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Quadrilaterals, EveryPack,
                         testing::Combine(testing::Values(test::quadrilateral), testing::Range(1, 9), testing::Bool()));
INSTANTIATE_TEST_SUITE_P(Triangles, EveryPack,
                         testing::Combine(testing::Values(test::triangle), testing::Values(1, 2),
                                          testing::Values(false)));

TEST_P(EveryPack, TheProductIsThatOfTheCells) {
  on_all([](const energy::ShellOperator& shell) {
    const algebra::Vector y = random_values(shell.space(), 6, 1);
    algebra::Vector packed(shell.space().layout, 6), plain = packed;
    packed.fill(7);  // earlier contents must not matter
    shell.apply(y, packed);
    for (std::size_t c = 0; c < shell.space().owned_cells; ++c)
      shell.scatter(c, shell.forces(c, shell.weighted_stresses(c, shell.strains(c, shell.gather(c, y)))), plain);
    plain.accumulate_ghosts();
    EXPECT_LT(relative_difference(packed, plain), 1e-14);
  });
}

TEST_P(EveryPack, TheEnergiesAreThoseOfTheCells) {
  on_all([](const energy::ShellOperator& shell) {
    const algebra::Vector y = random_values(shell.space(), 6, 2);
    energy::Energies plain;
    for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
      const energy::CellStrain strains = shell.strains(c, shell.gather(c, y));
      const auto work = (strains.array() * shell.weighted_stresses(c, strains).array()).colwise().sum().eval();
      plain.membrane += work.head<3>().sum() / 2;
      plain.bending += work.segment<3>(3).sum() / 2;
      plain.shear += work.tail<2>().sum() / 2;
    }
    const energy::Energies packed = shell.energies(y);
    const auto expect_same = [&](double in_packs, double of_cells) {
      of_cells = algebra::sum_over_ranks(of_cells, MPI_COMM_WORLD);
      EXPECT_NEAR(in_packs, of_cells, 1e-14 * packed.total());  // with coupling, a part is a difference of larger sums
    };
    expect_same(packed.membrane, plain.membrane);
    expect_same(packed.bending, plain.bending);
    expect_same(packed.shear, plain.shear);
  });
}

TEST_P(EveryPack, TheFormOfTheNormalRotationIsThatOfTheCells) {
  on_all([](const energy::ShellOperator& shell) {
    const algebra::Vector y = random_values(shell.space(), 6, 3);
    algebra::Vector packed = random_values(shell.space(), 6, 4), plain = packed, sum(shell.space().layout, 6);
    packed.accumulate_ghosts();
    plain = packed;
    add_normal_rotation_form(shell, 3, y, packed);
    packed.accumulate_ghosts();
    for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
      energy::CellGradient g = normal_rotation_gradients(shell, c, shell.gather(c, y));
      for (int q = 0; q < g.rows(); ++q) {
        const energy::QuadraturePoint p = shell.point(c, q);
        g.row(q) = 3 * p.young * std::pow(p.thickness, 3) * p.area * (g.row(q) * p.frame.metric_con).eval();
      }
      element::CellField forces = element::CellField::Zero(shell.tables().nodes_per_cell(), 6);
      add_normal_rotation_forces(shell, c, g, forces);
      shell.scatter(c, forces, sum);
    }
    sum.accumulate_ghosts();
    algebra::axpy(1, sum, plain);
    EXPECT_LT(relative_difference(packed, plain), 1e-14);
  });
}

// b(y, q) = int a^{ab} d_a(r . a_3) d_b q sqrt(a) dx from the cells' gradients, against both maps.
TEST_P(EveryPack, TheCouplingOfTheMultiplierIsThatOfTheCells) {
  on_all([](const energy::ShellOperator& shell) {
    const fem::Space& space = shell.space();
    const algebra::Vector y = random_values(space, 6, 5);
    algebra::Vector lambda = random_values(space, 1, 6);
    const element::BasisAt& basis = shell.tables().quadrature;
    algebra::Vector q(space.layout, 1), f(space.layout, 6), plain(space.layout, 1), plain_f(space.layout, 6);
    apply_coupling(shell, y, q);
    apply_coupling_transposed(shell, lambda, f);
    for (std::size_t c = 0; c < space.owned_cells; ++c) {
      const auto nodes = space.nodes(c);
      Eigen::VectorXd values(nodes.size());
      for (std::size_t i = 0; i < nodes.size(); ++i) values[i] = lambda.local()[nodes[i]];
      energy::CellGradient of_rotation = normal_rotation_gradients(shell, c, shell.gather(c, y)),
                           of_lambda(of_rotation.rows(), 2);
      of_lambda << basis.d1 * values, basis.d2 * values;
      for (int p = 0; p < of_lambda.rows(); ++p) {
        const energy::QuadraturePoint point = shell.point(c, p);
        for (energy::CellGradient* g : {&of_rotation, &of_lambda})
          g->row(p) = point.area * (g->row(p) * point.frame.metric_con).eval();
      }
      const Eigen::VectorXd of_cell =
          basis.d1.transpose() * of_rotation.col(0) + basis.d2.transpose() * of_rotation.col(1);
      for (std::size_t i = 0; i < nodes.size(); ++i) plain.local()[nodes[i]] += of_cell[i];
      element::CellField forces = element::CellField::Zero(shell.tables().nodes_per_cell(), 6);
      add_normal_rotation_forces(shell, c, of_lambda, forces);
      shell.scatter(c, forces, plain_f);
    }
    plain.accumulate_ghosts();
    plain_f.accumulate_ghosts();
    EXPECT_LT(relative_difference(q, plain), 1e-14);
    EXPECT_LT(relative_difference(f, plain_f), 1e-14);
  });
}

TEST(CellPacks, WhatIsStoredGivesTheFrameOfTheSurface) {
  const auto m = strip_of(test::quadrilateral, 3);
  for (const energy::PackKernels* kernels : energy::pack_kernels()) {
    const energy::ShellOperator shell = shell_on(m, true, *kernels);
    const auto& xi = shell.tables().quadrature.xi;
    std::vector<geometry::Frame> frames(xi.size());
    for (std::size_t c = 0; c < m.space->owned_cells; ++c) {
      m.surface->frames(m.space->cells[c], xi, frames);
      for (std::size_t q = 0; q < xi.size(); ++q) {
        const geometry::Frame stored = shell.point(c, static_cast<int>(q)).frame, &direct = frames[q];
        EXPECT_LT((stored.metric_con - direct.metric_con).norm(), 1e-14 * direct.metric_con.norm());
        EXPECT_LT((stored.b_cov - direct.b_cov).norm(), 1e-14);
        for (int a = 0; a < 2; ++a) EXPECT_LT((stored.da3[a] - direct.da3[a]).norm(), 1e-14);
        EXPECT_NEAR(stored.sqrt_a, direct.sqrt_a, 1e-14 * direct.sqrt_a);
      }
    }
  }
}

// Numbers of rows and columns that are not multiples of a block.
TEST(PackKernels, TheGramMatrixIsTheTransposeTimesTheMatrix) {
  for (const energy::PackKernels* kernels : energy::pack_kernels())
    for (const int columns : {1, 3, 20, 45, 54, 101}) {
      const RowMatrix b = RowMatrix::Random(17, columns), expected = b.transpose() * b;
      RowMatrix k = RowMatrix::Constant(columns, columns, NAN);
      kernels->gram(b.data(), 17, columns, k.data());
      double worst = 0;
      for (int i = 0; i < columns; ++i)
        for (int j = 0; j <= i; ++j) worst = test::larger(worst, std::abs(k(i, j) - expected(i, j)));
      EXPECT_LT(worst, 1e-14) << kernels->name << ", " << columns << " columns";
    }
}

}  // namespace
}  // namespace plastron::assembly
