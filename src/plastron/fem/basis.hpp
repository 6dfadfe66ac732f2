// One-dimensional quadrature points and Lagrange bases on [0, 1]; all tensor-product tables are made from them.
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

namespace plastron::fem {

struct Rule {
  std::vector<double> points;   ///< ascending, in [0, 1]
  std::vector<double> weights;  ///< sum to 1
};

Rule gauss(int points);          ///< exact for degree 2 points - 1
Rule gauss_lobatto(int points);  ///< end points included; exact for degree 2 points - 3

/// The Lagrange polynomials of given nodes and their first two derivatives at a point x.
struct LagrangeValues {
  Eigen::VectorXd value, d, dd;
};
LagrangeValues lagrange(std::span<const double> nodes, double x);

/// Tables of a one-dimensional Lagrange basis at points: a row per point, a column per node.
struct LagrangeTable {
  Eigen::MatrixXd value, d;
};
LagrangeTable lagrange_table(std::span<const double> nodes, std::span<const double> points);

}  // namespace plastron::fem
