// Tensor-product tables of the quadrilateral of degree k with Gauss-Lobatto nodes: basis at the quadrature points, and
// the points and interpolation of tying (M22). All points lie in the unit square, xi_1 running fastest.
#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace plastron::assembly {

using Eigen::MatrixXd;
using Eigen::Vector2d;

/// The element's basis at a set of points: rows are points, columns nodes.
struct BasisAt {
  std::vector<Vector2d> xi;
  MatrixXd value, d1, d2;
};

/// Strain components that tying treats alike, because they are sampled at the same points.
enum class TiedGroup { along_1, along_2, mixed };  ///< gamma_11 and delta_1; gamma_22 and delta_2; gamma_12

/// One set of sampling points with the components sampled there and the way back to the quadrature points.
struct Sampling {
  BasisAt basis;
  std::vector<int> membrane;  ///< components of the membrane strain (0: 11, 1: 22, 2: 2 x 12)
  std::vector<int> shear;     ///< components of the shear strain
  /// value at quadrature point q = sum over (point, weight) of to_quadrature[q]
  std::vector<std::vector<std::pair<int, double>>> to_quadrature;
};

struct ElementTables {
  int degree;
  bool tying;
  BasisAt quadrature;           ///< (k+1) x (k+1) Gauss points
  std::vector<double> weights;  ///< their weights on the unit square
  std::vector<Sampling>
      samplings;                ///< membrane and shear strains: three tied sets, or the quadrature points themselves
  std::vector<Vector2d> nodes;  ///< Gauss-Lobatto nodes
  std::vector<double> nodal_weights;  ///< Gauss-Lobatto weights on the unit square

  int nodes_per_cell() const { return static_cast<int>(nodes.size()); }
  int points_per_cell() const { return static_cast<int>(weights.size()); }
};

ElementTables element_tables(int degree, bool tying);

/// The element's basis at any points of the unit square.
BasisAt basis_at(int degree, const std::vector<Vector2d>& xi);

/// Interpolation of each sampling to any points: the tied strains are defined in the whole cell.
/// Result [s](p, t): weight of sampling point t at point p.
std::vector<MatrixXd> tied_interpolation(const ElementTables& tables, const std::vector<Vector2d>& xi);

}  // namespace plastron::assembly
