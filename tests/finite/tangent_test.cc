// Forces and stiffness of the shell with finite rotations: derivatives of the energy (M27) along directors of length 1.
#include <plastron/assembly/deformed.hpp>
#include <plastron/finite/tangent.hpp>
#include <plastron/mesh/basis.hpp>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/sample_shells.hpp"

namespace plastron::finite {
namespace {

using assembly::DiscreteShell;
using assembly::NodalPoint;
using Eigen::Vector3d;

const std::vector<test::Element> elements{{test::quadrilateral, 1, true},
                                          {test::quadrilateral, 3, true},
                                          {test::quadrilateral, 2, false},
                                          {test::triangle, 2, false}};

/// A loaded shell of two or more cells without supports.
std::unique_ptr<DiscreteShell> make(const test::Element& element, const std::array<std::string, 3>& chart,
                                    element::Rotations rotations = element::Rotations::finite) {
  const auto [shape, degree, tying] = element;
  const auto m = test::meshed(domain::Rectangle{.cells = {2, 1}}, chart, degree, 1, shape);
  assembly::ShellDescription description{.sections = test::steel_of(geometry::Expression(0.1)), .tying = tying};
  description.rotations = rotations;
  const auto of = [](double c) { return geometry::Expression(c); };
  description.loads.on_areas = {{.force = {of(0.02), of(-0.01), of(0.03)}, .couple = {of(0.01), of(0.02), of(0)}}};
  return assembly::discretise(m.space, m.surface, description);
}

/// A smooth field (u, r).
algebra::Vector some_field(const DiscreteShell& discrete, double phase) {
  return test::interpolant(discrete.shell, [&](const NodalPoint& p) {
    assembly::Vector6 y;
    for (int k = 0; k < 6; ++k) y[k] = 0.4 * p.x[0] * std::sin(phase + k + 2 * p.x[0] - (k + 1) * p.x[1]);
    return y;
  });
}

algebra::Vector sum(algebra::Vector y, double factor, const algebra::Vector& z) {
  for (std::size_t i = 0; i < y.local().size(); ++i) y.local()[i] += factor * z.local()[i];
  return y;
}

/// Returns W - l (M27).
double potential(const DiscreteShell& discrete, const algebra::Vector& y) {
  return discrete.energies(y).total() - algebra::dot(discrete.load, y);
}

/// Linearises the shell at y; returns its stresses there.
Prestress linearise_at(DiscreteShell& discrete, algebra::Vector y) {
  linearise(discrete, {.displacement = std::move(y)});
  return prestress(discrete, solution::nodal_solution(discrete, algebra::Vector(discrete.space().layout, 1)));
}

TEST(UnbalancedForces, AreTheDerivativeOfThePotential) {
  for (const test::Element& element : elements) {
    const auto discrete = make(element, test::saddle);
    const algebra::Vector y = some_field(*discrete, 0.2), w = some_field(*discrete, 1.1);
    algebra::Vector f(discrete->space().layout, 6);
    discrete->residual(y, f);
    const double f_w = algebra::dot(f, w);
    // The potential is a polynomial of fourth degree: the difference of this order is exact.
    const auto slope = [&](double t) {
      return (potential(*discrete, sum(y, t, w)) - potential(*discrete, sum(y, -t, w))) / (2 * t);
    };
    EXPECT_NEAR(f_w, (4 * slope(0.5) - slope(1)) / 3, 1e-11 * std::abs(f_w));
  }
}

/// Values of coordinates that are the same on any number of ranks.
algebra::Vector some_coordinates(const DiscreteShell& discrete) {
  const algebra::Layout& layout = *discrete.space().layout;
  algebra::Vector z(discrete.space().layout, 5);
  for (std::size_t i = 0; i < z.owned().size(); ++i)
    z.owned()[i] = std::sin(1.0 + 3.7 * static_cast<double>(layout.first * 5 + static_cast<std::int64_t>(i)));
  z.update_ghosts();
  return z;
}

TEST(TangentMatrix, IsTheSecondDerivativeOfThePotentialOnDirectorsOfLengthOne) {
  for (const test::Element& element : elements) {
    const auto discrete = make(element, test::saddle);
    const Prestress prestress = linearise_at(*discrete, some_field(*discrete, 0.2));
    const algebra::Matrix K = tangent_matrix(*discrete, prestress, discrete->coordinates);
    const algebra::Vector z = some_coordinates(*discrete), &y = discrete->state.displacement;
    algebra::Vector w(discrete->space().layout, 6), K_z(z);
    K.multiply(z, K_z);
    discrete->coordinates.to_cartesian(z, w);
    const auto along = [&](double t) {
      return potential(*discrete, with_kept_lengths(discrete->space(), discrete->points, sum(y, t, w)));
    };
    const double t = 1e-3, second = algebra::dot(z, K_z);
    const auto difference = [&](double s) { return (along(s) - 2 * along(0) + along(-s)) / (s * s); };
    const double exact = (4 * difference(t) - difference(2 * t)) / 3;
    // Where strains are tied, compressive forces leave out motions that these do not see: the matrix is a little stiffer.
    const bool is_tied = std::get<bool>(element);
    EXPECT_NEAR(second, exact, (is_tied ? 0.02 : 1e-6) * std::abs(second));
    EXPECT_GE(second, exact - 1e-6 * std::abs(second));
  }
}

/// The tied strain 12 does not see u = P_k(xi_2) f(xi_1): it has no stiffness by which such a motion could resist its coupling to r.
TEST(GeometricStiffness, OfMomentsLeavesOutMotionsThatTiedStrainsDoNotSee) {
  for (const int degree : {1, 2, 3, 4, 6})
    for (const Eigen::Index moment : {3, 4}) {
      const auto discrete = make({test::quadrilateral, degree, true}, test::flat);
      CellStrain stresses = CellStrain::Zero(discrete->shell.tables().points_per_cell(), 8);
      stresses.col(moment).setOnes();
      const std::vector<double> nodes = mesh::gauss_lobatto(degree + 1).points;
      const auto motion = [&](bool is_seen) {
        element::CellField field = element::CellField::Zero(static_cast<Eigen::Index>(nodes.size() * nodes.size()), 6);
        for (std::size_t i = 0; i < nodes.size() * nodes.size(); ++i) {
          const double across = nodes[moment == 3 ? i % nodes.size() : i / nodes.size()];
          const double along = nodes[moment == 3 ? i / nodes.size() : i % nodes.size()];
          const double shape = is_seen ? 1 : std::legendre(static_cast<unsigned>(degree), 2 * along - 1);
          for (const Eigen::Index d : {1, 4}) field(static_cast<Eigen::Index>(i), d) = shape * (1 + across);
        }
        return field.cwiseProduct(geometric_forces(discrete->shell, stresses, field)).sum();
      };
      EXPECT_GT(motion(true), 1e-3) << degree;
      EXPECT_NEAR(motion(false), 0, 1e-10 * motion(true)) << degree;
    }
}

TEST(TangentMatrix, OfTheUndeformedShellIsTheStiffnessOfTheLinearModelToTheLastBit) {
  for (const test::Element& element : elements) {
    const auto discrete = make(element, test::saddle), small = make(element, test::saddle, element::Rotations::small);
    const Prestress none = linearise_at(*discrete, algebra::Vector(discrete->space().layout, 6));
    discrete->load.fill(0);  // couples along a_3 bend the sphere of directors
    const algebra::Matrix linear = assembly::stiffness_matrix(*small),
                          tangent = tangent_matrix(*discrete, none, discrete->coordinates);
    algebra::Vector z = some_coordinates(*discrete), of_linear(z), of_tangent(z);
    linear.multiply(z, of_linear);
    tangent.multiply(z, of_tangent);
    EXPECT_TRUE(std::ranges::equal(of_linear.owned(), of_tangent.owned()));
  }
}

// Exact on a flat plate, whose chart the element reproduces.
TEST(Stresses, OfAPlateThatTurnsByAnyAngleAreZero) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.0, Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix() - Eigen::Matrix3d::Identity();
  for (const test::Element& element : elements) {
    const auto discrete = make(element, test::flat);
    const auto y = test::interpolant(discrete->shell, [&](const NodalPoint& p) {
      return (assembly::Vector6() << turn * p.phi + Vector3d(1, 2, 3), turn * p.a3).finished();
    });
    for (std::size_t c = 0; c < discrete->space().owned_cells; ++c)
      EXPECT_LT(discrete->stresses(c, discrete->strains(c, y)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace plastron::finite
