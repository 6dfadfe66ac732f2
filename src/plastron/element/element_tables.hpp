// Tables of the element of degree k: basis at the quadrature points, nodal quadrature (M21), and the points and
// interpolation of tying (M22). Quadrilaterals are tensor products with Gauss-Lobatto nodes. Triangles (M20) of degree
// 1 and 2 have equidistant nodes and no tying. All points lie in the reference cell, nodes run with xi_1 fastest.
#pragma once
#include <plastron/mesh/basis.hpp>

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace plastron::element {

using Eigen::MatrixXd;
using Eigen::Vector2d;

/// The element's basis at a set of points: a row per point, a column per node.
struct BasisAt {
  std::vector<Vector2d> xi;
  MatrixXd value, d1, d2;
};

/// Strain components in groups that tying samples at the same points.
enum class TiedGroup { along_1, along_2, mixed };  ///< gamma_11 and delta_1; gamma_22 and delta_2; gamma_12

/// One set of sampling points, the components sampled there, and the interpolation to the quadrature points.
struct Sampling {
  BasisAt basis;
  std::vector<int> membrane;  ///< components of the membrane strain (0: 11, 1: 22, 2: 2 x 12)
  std::vector<int> shear;     ///< components of the shear strain
  /// value at quadrature point q = sum over (point, weight) of to_quadrature[q]
  std::vector<std::vector<std::pair<int, double>>> to_quadrature;
};

struct ElementTables {
  mesh::Shape shape = mesh::Shape::quadrilateral;
  int degree = 1;
  bool tying = false;           ///< false on triangles
  BasisAt quadrature;           ///< (k+1) x (k+1) Gauss points; on triangles a symmetric rule of degree 2k + 2
  std::vector<double> weights;  ///< weights of the points on the reference cell
  std::vector<Sampling>
      samplings;                ///< membrane and shear strains: three tied sets, or the quadrature points themselves
  std::vector<Vector2d> nodes;  ///< Gauss-Lobatto nodes; equidistant on triangles
  /// Weights of the nodes on the reference cell: the non-negative rule of highest degree. Quadrilaterals:
  /// Gauss-Lobatto. Triangles of area A: A/3 at vertices (degree 1); A/3 at the middles of edges and 0 at vertices
  /// (degree 2).
  std::vector<double> nodal_weights;

  int nodes_per_cell() const { return static_cast<int>(nodes.size()); }
  int points_per_cell() const { return static_cast<int>(weights.size()); }
};

/// Returns the tables. Triangles are never tied, even if `tying` is true. Precondition: degree 1 or 2 on triangles.
ElementTables element_tables(mesh::Shape shape, int degree, bool tying);

/// The element's basis at given points of the reference cell.
BasisAt basis_at(mesh::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// The basis that interpolates nodal values of the reaction at points: a row per point, a column per node. It is the
/// element's basis. On triangles of degree 2 it is the linear function through the middles of the edges, the only
/// nodes with a bound. Its integral equals the nodal quadrature.
MatrixXd reaction_basis_at(mesh::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// Points of highest accuracy for stress resultants: k x k Gauss points; on triangles the centroid or the three
/// interior points of the rule of degree 2.
std::vector<Vector2d> resultant_points(mesh::Shape shape, int degree);
/// Continues values at the resultant points to other points as polynomials of degree k - 1: a row per point, a column
/// per resultant point.
MatrixXd resultant_continuation(mesh::Shape shape, int degree, const std::vector<Vector2d>& xi);

/// Interpolation of each sampling to given points: tied strains are defined in the whole cell. Empty without tying,
/// when strains are evaluated at the points themselves. Result [s](p, t): weight of sampling point t at point p.
std::vector<MatrixXd> tied_interpolation(const ElementTables& tables, const std::vector<Vector2d>& xi);

/// Tables of a square element along one direction; the tables in the square are their tensor products. Derivatives and
/// values at all points of a cell cost degree^3 operations instead of degree^4 (sum factorisation), and so does tying
/// (M22). A row per point, a column per node of the Gauss-Lobatto rule (of the reduced Gauss rule for `from_reduced`).
struct LineTables {
  mesh::LagrangeTable full;      ///< at the degree + 1 Gauss points
  mesh::LagrangeTable reduced;   ///< at the `degree` Gauss points where tying samples
  Eigen::MatrixXd from_reduced;  ///< interpolation from the reduced to the full Gauss points
};

LineTables line_tables(int degree);

}  // namespace plastron::element
