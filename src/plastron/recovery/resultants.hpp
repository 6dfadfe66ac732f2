// Stress resultants of a solution where the element knows them best.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/recovery/surface_axes.hpp>

#include <vector>

namespace plastron::recovery {

using certificate::NodalSolution;

/// N_11 N_22 N_12 [N/m], M likewise [N], Q_1 Q_2 [N/m], a row a point.
using ResultantRows = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;
using Resultants = Eigen::Matrix<double, 1, 8>;

/// The same in other axes: `change` as change_of_axes() gives it.
Resultants in_other_axes(const Resultants& resultants, const Eigen::Matrix2d& change);

/// Weights w' with w' . resultants = w . in_other_axes(resultants, change) for all resultants.
Resultants in_other_axes_transposed(const Resultants& weights, const Eigen::Matrix2d& change);

/// A point of a cell with its resultants in its axes.
struct CellResultants {
  std::vector<Vector3d> position;  ///< phi [m]
  std::vector<SurfaceAxes> axes;
  ResultantRows values;
};

/// Takes resultants from strains at element::resultant_points(), where they converge an order faster than elsewhere.
class ResultantPoints {
 public:
  /// `axis`: see surface_axes().
  explicit ResultantPoints(const assembly::DiscreteShell& discrete, std::optional<Vector3d> axis = {});
  /// Of an owned cell with the nodal values `field`.
  CellResultants operator()(std::size_t cell, const element::CellField& field) const;
  const element::BasisAt& basis() const { return basis_; }

 private:
  const assembly::DiscreteShell& discrete_;
  std::optional<Vector3d> axis_;
  element::BasisAt basis_;
  std::vector<Eigen::MatrixXd> tied_;  // tied strains: sampling points -> resultant points
};

}  // namespace plastron::recovery
