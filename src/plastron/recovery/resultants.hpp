// Stress resultants of a solution at the points of highest accuracy in each element.
#pragma once
#include <plastron/recovery/surface_axes.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <vector>

namespace plastron::recovery {

using solution::NodalSolution;

/// N_11 N_22 N_12 [N/m], M_11 M_22 M_12 [N], Q_1 Q_2 [N/m]; a row per point.
using ResultantRows = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;
using Resultants = Eigen::Matrix<double, 1, 8>;

/// Transforms resultants to other axes; `change` is a result of change_of_axes().
Resultants in_other_axes(const Resultants& resultants, const Eigen::Matrix2d& change);

/// Weights w' with w' . resultants = w . in_other_axes(resultants, change) for all resultants.
Resultants in_other_axes_transposed(const Resultants& weights, const Eigen::Matrix2d& change);

/// Points of a cell with their axes and the resultants in these axes.
struct CellResultants {
  std::vector<Vector3d> position;  ///< phi [m]
  std::vector<SurfaceAxes> axes;
  ResultantRows values;
};

/// Computes resultants from strains at element::resultant_points(), where they converge one order faster than
/// elsewhere.
class ResultantPoints {
 public:
  /// `axis`: see surface_axes().
  explicit ResultantPoints(const assembly::DiscreteShell& discrete, std::optional<Vector3d> axis = {});
  /// Returns the resultants of an owned cell with the nodal values `field`.
  CellResultants operator()(std::size_t cell, const element::CellField& field) const;
  const element::BasisAt& basis() const { return basis_; }

 private:
  const assembly::DiscreteShell& discrete_;
  std::optional<Vector3d> axis_;
  element::BasisAt basis_;
  std::vector<Eigen::MatrixXd> tied_;  // maps tied strains from sampling points to resultant points
};

}  // namespace plastron::recovery
