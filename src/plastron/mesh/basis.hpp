// Lagrange polynomials and quadrature: on [0, 1], from which all tables of quadrilaterals are made as tensor products,
// and on the reference triangle (0,0), (1,0), (0,1).
#pragma once
#include <plastron/mesh/reference_cell.hpp>

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace plastron::mesh {

struct Rule {
  std::vector<double> points;   ///< ascending, in [0, 1]
  std::vector<double> weights;  ///< sum to 1
};

Rule gauss(int points);          ///< exact for degree 2 points - 1
Rule gauss_lobatto(int points);  ///< end points included; exact for degree 2 points - 3

/// The Lagrange polynomials of given nodes and their first two derivatives at a point x.
struct LagrangeValues {
  static constexpr int most_nodes = 16;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_nodes, 1>;  ///< without an allocation
  Vector value, d, dd;
};
/// Precondition: not more than most_nodes nodes.
LagrangeValues lagrange(std::span<const double> nodes, double x);

/// Tables of a one-dimensional Lagrange basis at points: a row per point, a column per node.
struct LagrangeTable {
  Eigen::MatrixXd value, d;
};
LagrangeTable lagrange_table(std::span<const double> nodes, std::span<const double> points);

/// The Lagrange polynomials of lattice(shape, order) and their first two derivatives at a point, in the order of the
/// lattice.
struct LatticeValues {
  Eigen::VectorXd value;
  std::array<Eigen::VectorXd, 2> d;   ///< d_1, d_2
  std::array<Eigen::VectorXd, 3> dd;  ///< d_11, d_12, d_22
};
LatticeValues lattice_values(Shape shape, int order, const Vector2d& xi);

/// The same polynomials and their first derivatives at points: a row per point, a column per node.
struct LatticeTable {
  std::vector<Vector2d> xi;
  Eigen::MatrixXd value, d1, d2;
};
LatticeTable lattice_table(Shape shape, int order, std::vector<Vector2d> xi);

/// The nodes of a cell of degree k in its own coordinates, xi_1 fastest: Gauss-Lobatto points of a quadrilateral, the
/// lattice of a triangle.
std::vector<Vector2d> node_points(Shape shape, int degree);

struct TriangleRule {
  std::vector<Vector2d> points;  ///< points inside the triangle
  std::vector<double> weights;   ///< positive; sum to its area 1/2
};
/// Returns a rule that is exact for polynomials of the given degree. Degrees 1, 2, 4 and 6 have symmetric rules of 1,
/// 3, 6 and 12 points (D. A. Dunavant, Int. J. Numer. Meth. Eng. 21, 1985), so that a cell may begin at any of its
/// corners. Other degrees have Gauss rules of the square collapsed onto the triangle.
TriangleRule triangle_rule(int degree);

}  // namespace plastron::mesh
