#include <plastron/geometry/chart.hpp>
#include <plastron/geometry/frame.hpp>

#include <gtest/gtest.h>

namespace plastron::geometry {
namespace {

const Chart& wavy() {
  static const Chart chart({"x + 0.1*y^2", "y - 0.2*x*y", "0.3*sin(x)*cos(2*y)"}, {});
  return chart;
}

SurfaceJet jet_at(double x, double y) {
  std::array<SurfaceJet, 1> jets;
  wavy().evaluate(std::array{x}, std::array{y}, jets, true);
  return jets[0];
}

/// Cell coordinates that are a quadratic map of the parameters.
PlaneJet parameters_at(const Vector2d& xi) {
  PlaneJet f;
  f.value = {0.4 + 0.3 * xi[0] + 0.1 * xi[0] * xi[1], 0.2 - 0.1 * xi[0] + 0.5 * xi[1]};
  f.d[0] = {0.3 + 0.1 * xi[1], -0.1};
  f.d[1] = {0.1 * xi[0], 0.5};
  f.dd[1] = {0.1, 0};
  return f;
}

MovingBasis basis_at(const Vector2d& xi) {
  const PlaneJet f = parameters_at(xi);
  const SurfaceJet phi = jet_at(f.value[0], f.value[1]);
  return moving_basis(phi, compose(phi, f).d);
}

TEST(MovingBasis, IsDualToTheCovariantBasisOfTheChart) {
  const PlaneJet f = parameters_at({0.3, 0.7});
  const Matrix3d product = covariant_basis(jet_at(f.value[0], f.value[1])).transpose() * basis_at({0.3, 0.7}).a;
  EXPECT_NEAR((product - Matrix3d::Identity()).norm(), 0, 1e-14);
}

TEST(MovingBasis, HasTheDerivativesThatDifferencesGive) {
  constexpr double h = 1e-5;
  const Vector2d xi(0.3, 0.7);
  for (int b = 0; b < 2; ++b) {
    const Matrix3d difference =
        (basis_at(xi + h * Vector2d::Unit(b)).a - basis_at(xi - h * Vector2d::Unit(b)).a) / (2 * h);
    EXPECT_NEAR((difference - basis_at(xi).da[static_cast<std::size_t>(b)]).norm(), 0, 1e-9);
  }
}

}  // namespace
}  // namespace plastron::geometry
