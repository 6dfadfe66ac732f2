// A map at a point with its first and second partial derivatives. Second derivatives are stored in the order 11, 12,
// 22.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

namespace plastron::geometry {

using Eigen::Vector2d;
using Eigen::Vector3d;

template <class Point>
struct Jet {
  Point value = Point::Zero();
  std::array<Point, 2> d{Point::Zero(), Point::Zero()};
  std::array<Point, 3> dd{Point::Zero(), Point::Zero(), Point::Zero()};
};

using SurfaceJet = Jet<Vector3d>;  ///< phi and its derivatives
using PlaneJet = Jet<Vector2d>;    ///< a map of the parameter plane into itself

/// The jet of phi o f in f's own coordinates (chain rule), given the jet of phi at f's value.
inline SurfaceJet compose(const SurfaceJet& phi, const PlaneJet& f) {
  SurfaceJet c;
  c.value = phi.value;
  for (int a = 0; a < 2; ++a) c.d[a] = phi.d[0] * f.d[a][0] + phi.d[1] * f.d[a][1];
  constexpr int row[3] = {0, 0, 1}, column[3] = {0, 1, 1};
  for (int k = 0; k < 3; ++k) {
    const Vector2d& p = f.d[row[k]];
    const Vector2d& q = f.d[column[k]];
    c.dd[k] = phi.dd[0] * (p[0] * q[0]) + phi.dd[1] * (p[0] * q[1] + p[1] * q[0]) + phi.dd[2] * (p[1] * q[1]) +
              phi.d[0] * f.dd[k][0] + phi.d[1] * f.dd[k][1];
  }
  return c;
}

}  // namespace plastron::geometry
