// Tables of the element of degree k: basis at the quadrature points, nodal quadrature (M21), and the points and
// interpolation of tying (M22). Quadrilaterals are tensor products with Gauss-Lobatto nodes. Triangles (M20) of degree
// 1 and 2 have equidistant nodes and no tying. All points lie in the reference cell, nodes run with xi_1 fastest.
#pragma once
#include <plastron/fem/reference_cell.hpp>

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace plastron::element {

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
  fem::Shape shape = fem::Shape::quadrilateral;
  int degree = 1;
  bool tying = false;           ///< never on triangles
  BasisAt quadrature;           ///< (k+1) x (k+1) Gauss points; on triangles a symmetric rule of degree 2k + 2
  std::vector<double> weights;  ///< their weights on the reference cell
  std::vector<Sampling>
      samplings;                ///< membrane and shear strains: three tied sets, or the quadrature points themselves
  std::vector<Vector2d> nodes;  ///< Gauss-Lobatto nodes; equidistant on triangles
  /// Weights of the nodes on the reference cell, the exactest non-negative rule there is: Gauss-Lobatto; on triangles of
  /// area A a third of A at vertices (degree 1), at the middles of edges and none at vertices (degree 2).
  std::vector<double> nodal_weights;

  int nodes_per_cell() const { return static_cast<int>(nodes.size()); }
  int points_per_cell() const { return static_cast<int>(weights.size()); }
};

/// Triangles are not tied, whatever `tying` says. Precondition: degree 1 or 2 on triangles.
ElementTables element_tables(fem::Shape shape, int degree, bool tying);

/// The element's basis at any points of the reference cell.
BasisAt basis_at(fem::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// What carries nodal values of the reaction to any points, rows points and columns nodes: the element's basis; on
/// triangles of degree 2 the linear function through the middles of the edges, the only nodes with a bound. Its
/// integral is that of the nodal quadrature.
MatrixXd reaction_basis_at(fem::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// Points where stress resultants are best: k x k Gauss points; the centroid or the three interior points of the rule
/// of degree 2 on triangles.
std::vector<Vector2d> resultant_points(fem::Shape shape, int degree);
/// Continues values at those points to others as polynomials of degree k - 1: rows points, columns resultant points.
MatrixXd resultant_continuation(fem::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// Interpolation of each sampling to any points: the tied strains are defined in the whole cell. Empty without tying:
/// then strains are taken at the points themselves.
/// Result [s](p, t): weight of sampling point t at point p.
std::vector<MatrixXd> tied_interpolation(const ElementTables& tables, const std::vector<Vector2d>& xi);

}  // namespace plastron::element
