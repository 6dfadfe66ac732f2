// A test whether the polynomial map of a cell is one to one: the sign of its determinant at many points.
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::fem {

/// The Lagrange polynomials of lattice(shape, order) and their derivatives at points dense enough to detect a change
/// of sign of a determinant of their degree. A row per point, a column per node.
struct JacobianTable {
  std::vector<Vector2d> xi;
  Eigen::MatrixXd value, d1, d2;
};
JacobianTable jacobian_table(Shape shape, int order);

struct JacobianRange {
  bool is_positive = true, is_negative = true;  ///< at all points
  Vector2d worst = Vector2d::Zero();  ///< image of the point where the cell is most nearly degenerate, or folded
};
/// Evaluates the determinant of the map through `nodes`, which are in the order of the lattice.
JacobianRange jacobian_range(const JacobianTable& table, const std::vector<Vector2d>& nodes);

}  // namespace plastron::fem
