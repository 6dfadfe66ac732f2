// Results at points: displacement, rotation, gap, reaction, stress resultants in an orthonormal frame of the surface.
#pragma once
#include <plastron/certificate/certificate.hpp>

#include <vector>

namespace plastron::certificate {

/// N, M, Q are components in the orthonormal frame (t1, t2): t1 = d phi/dx / |d phi/dx|, t2 = a_3 x t1.
struct PointValues {
  Eigen::Vector2d x = Eigen::Vector2d::Zero();  ///< parameters in Omega
  Vector3d phi = Vector3d::Zero();              ///< position on the undeformed mid-surface [m]
  Vector3d t1 = Vector3d::Zero(), t2 = Vector3d::Zero(), a3 = Vector3d::Zero();  ///< orthonormal frame
  double thickness = 0;                                                          ///< e [m]
  Vector3d u = Vector3d::Zero();                                                 ///< displacement [m]
  Vector3d r = Vector3d::Zero();                                                 ///< rotation of the normal [rad]
  double gap = 0;                 ///< of the touching face, the smallest of all obstacles [m]; NaN without
  double pressure = 0;            ///< eta, the sum of all obstacles [Pa]
  double lambda = 0;              ///< multiplier of (M14) [N m]
  double touching = 0;            ///< 1 in contact, 0 free; in between next to the zone's edge
  Vector3d N = Vector3d::Zero();  ///< N_11, N_22, N_12 [N/m]
  Vector3d M = Vector3d::Zero();  ///< M_11, M_22, M_12 [N]
  Eigen::Vector2d Q = Eigen::Vector2d::Zero();  ///< Q_1, Q_2 [N/m]
};

/// Evaluates a solution in cells at fixed points of the reference cell. Resultants are taken at resultant_points(),
/// where they are most accurate, and continued from there as polynomials of degree k - 1; they may jump between cells.
class Recovery {
 public:
  Recovery(const assembly::DiscreteShell& discrete, const NodalSolution& solution,
           const std::vector<Eigen::Vector2d>& xi);
  std::vector<PointValues> operator()(std::size_t cell) const;

 private:
  Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor> resultants_at_gauss_points(
      std::size_t cell, const element::CellField& field) const;

  const assembly::DiscreteShell& discrete_;
  const NodalSolution& solution_;
  element::BasisAt at_points_, at_gauss_;
  std::vector<MatrixXd> tied_at_gauss_;  // tied strains: sampling points -> reduced Gauss points
  MatrixXd from_gauss_;                  // reduced Gauss points -> points
  MatrixXd reaction_at_points_;          // nodal reactions -> points
};

}  // namespace plastron::certificate
