// The contravariant basis of a chart and its derivatives along the surface. The classical formulation (M15) expresses
// its unknowns in this basis.
#pragma once
#include <plastron/geometry/frame.hpp>

namespace plastron::geometry {

using Eigen::Matrix3d;

/// Columns a^1, a^2, a_3 of the chart's own parameters, and their derivatives along the coordinates of a cell.
struct MovingBasis {
  Matrix3d a;
  std::array<Matrix3d, 2> da;
};

/// The covariant basis a_1, a_2, a_3 as columns.
inline Matrix3d covariant_basis(const SurfaceJet& phi) {
  Matrix3d basis;
  basis << phi.d[0], phi.d[1], unit_normal(phi);
  return basis;
}

/// Computes the basis from phi's jets at one point in the chart's parameters and in the cell's coordinates. With C =
/// [a_1 a_2 a_3] the contravariant basis is G = C^{-T}, hence dG = -G (dC)' G.
inline MovingBasis moving_basis(const SurfaceJet& in_parameters, const SurfaceJet& in_cell) {
  const Frame f = frame_at(in_parameters);
  MovingBasis basis;
  basis.a << f.a_con[0], f.a_con[1], f.a3;
  std::array<Matrix3d, 2> along_parameter;
  for (int a = 0; a < 2; ++a) {
    Matrix3d dc;
    dc << in_parameters.dd[a], in_parameters.dd[a + 1], f.da3[a];
    along_parameter[a] = -basis.a * dc.transpose() * basis.a;
  }
  for (int b = 0; b < 2; ++b)
    basis.da[b] = f.a_con[0].dot(in_cell.d[b]) * along_parameter[0] + f.a_con[1].dot(in_cell.d[b]) * along_parameter[1];
  return basis;
}

}  // namespace plastron::geometry
