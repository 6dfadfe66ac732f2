// The tables of a square element along one direction, from which its tables in the square are tensor products: derivatives and
// values at all points of a cell then cost degree^3 operations in place of degree^4 (sum factorisation), and so does tying (M22).
#pragma once
#include <plastron/fem/basis.hpp>

namespace plastron::element {

/// Rows are points, columns nodes of the Gauss-Lobatto rule (of the reduced Gauss rule for `from_reduced`).
struct LineTables {
  fem::LagrangeTable full;       ///< at the degree + 1 Gauss points
  fem::LagrangeTable reduced;    ///< at the degree Gauss points at which tying samples
  Eigen::MatrixXd from_reduced;  ///< interpolation from the latter to the former
};

LineTables line_tables(int degree);

}  // namespace plastron::element
