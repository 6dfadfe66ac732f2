// Control of the loads by a displacement: their factor lambda is sought with which u . direction has a given value at a point,
// c . (u, r) = value. It passes limit points of the loads, where the stiffness has no positive eigenvalue in some direction:
// steps have K + rho c c' in the place of K, which changes nothing where c . z is given, and has a Cholesky factor as long as the
// equilibrium is stable under control.
#pragma once
#include <plastron/assembly/box_problem.hpp>
#include <plastron/fem/cell_point.hpp>

#include <optional>

namespace plastron::finite {

class ControlledPoint {
 public:
  /// Keeps a reference to `discrete`, whose state controls the loads (collective).
  explicit ControlledPoint(const assembly::DiscreteShell& discrete);

  /// Returns c in nodal coordinates.
  const algebra::Vector& row() const { return row_; }
  /// Returns the value of c . (u, r) less that of the state (collective) [m].
  double rest() const;
  /// Returns the derivative of loads less internal forces by lambda, in nodal coordinates (collective).
  algebra::Vector load_rate() const;
  /// Returns rho: a stiffness far above that of the shell at its nodes (collective) [N/m].
  double stiffness(const algebra::Matrix& matrix) const;
  /// Adds rho c c' to a matrix in nodal coordinates (collective).
  void add(double rho, algebra::Matrix& matrix) const;

 private:
  const assembly::DiscreteShell& discrete_;
  std::optional<fem::CellPoint> point_;
  Eigen::RowVectorXd cell_row_;  ///< c on (u, r) of the nodes of the point's cell; empty on other ranks
  algebra::Vector row_;
};

}  // namespace plastron::finite
