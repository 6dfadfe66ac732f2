// Stress resultants of a solution at the points of highest accuracy in each element, in orthonormal axes of the tangent
// plane, and their transformation between tangent planes.
#pragma once
#include <plastron/geometry/frame.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <optional>
#include <vector>

namespace plastron::recovery {

using geometry::Vector3d;

/// t1, t2 = a_3 x t1 and the unit normal a_3.
struct SurfaceAxes {
  Vector3d t1 = Vector3d::UnitX(), t2 = Vector3d::UnitY(), a3 = Vector3d::UnitZ();
};

/// Sine of the angle to the normal below which an axis counts as normal to the surface.
inline constexpr double parallel_sine = 1e-6;

/// Returns axes with t1 along the projection of `axis` on the surface. Without `axis`, or if it is normal to the
/// surface, t1 follows `tangent`.
SurfaceAxes surface_axes(const Vector3d& tangent, const Vector3d& a3, const std::optional<Vector3d>& axis);

/// The smallest rotation that turns the normal `from` into `to`. Precondition: they are not opposite.
Eigen::Matrix3d shortest_turn(const Vector3d& from, const Vector3d& to);

/// The 2 x 2 matrix that maps components in `from` to components in `to`, for column vectors. The axes `from` are
/// turned into the plane of `to` by the smallest rotation.
Eigen::Matrix2d change_of_axes(const SurfaceAxes& from, const SurfaceAxes& to);

/// C T C' for a symmetric tensor in the order 11, 22, 12.
Vector3d in_other_axes(const Vector3d& tensor, const Eigen::Matrix2d& change);

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
/// elsewhere. They are without the share of initial strains, which Recovery subtracts; those of motions are linear.
class ResultantPoints {
 public:
  /// `axis`: see surface_axes().
  explicit ResultantPoints(const assembly::DiscreteShell& discrete, assembly::FieldKind kind,
                           std::optional<Vector3d> axis = {});
  /// Returns the resultants of an owned cell with the nodal values `field`.
  CellResultants operator()(std::size_t cell, const element::CellField& field) const;
  const element::BasisAt& basis() const { return basis_; }

 private:
  const assembly::DiscreteShell& discrete_;
  assembly::FieldKind kind_;
  std::optional<Vector3d> axis_;
  element::BasisAt basis_;
  std::vector<Eigen::MatrixXd> tied_;  // maps tied strains from sampling points to resultant points
};

}  // namespace plastron::recovery
