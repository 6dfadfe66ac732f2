// Half the squared distance of X from the point of the graph z = h at p, with its derivatives with respect to p.
#pragma once
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/raster.hpp>

namespace plastron::obstacle {

struct GraphObjective {
  double value;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian, convex_part;
};

inline GraphObjective graph_objective(const Vector3d& X, const Eigen::Vector2d& p, const HeightJet& h) {
  const Eigen::Vector2d across = p - X.head<2>();
  const double up = h.value - X[2];
  const Eigen::Matrix2d convex = Eigen::Matrix2d::Identity() + h.gradient * h.gradient.transpose();
  return {(across.squaredNorm() + up * up) / 2, across + up * h.gradient, convex + up * h.hessian, convex};
}

inline bool is_positive(const Eigen::Matrix2d& m) { return m(0, 0) > 0 && m.determinant() > 0; }

}  // namespace plastron::obstacle
