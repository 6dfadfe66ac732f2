// Where the polynomial map of a cell is one to one: the sign of its determinant at many points.
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::fem {

/// The Lagrange polynomials of lattice(shape, order) and their derivatives at points close enough to see where a determinant of
/// their degree changes its sign: rows are points, columns nodes.
struct JacobianTable {
  std::vector<Vector2d> xi;
  Eigen::MatrixXd value, d1, d2;
};
JacobianTable jacobian_table(Shape shape, int order);

struct JacobianRange {
  bool is_positive = true, is_negative = true;  ///< everywhere
  Vector2d worst = Vector2d::Zero();  ///< image of the point where the cell is most nearly degenerate, or folds
};
/// Of the map through `nodes` in the order of the lattice.
JacobianRange jacobian_range(const JacobianTable& table, const std::vector<Vector2d>& nodes);

}  // namespace plastron::fem
