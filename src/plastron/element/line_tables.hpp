// Tables of a square element along one direction; the tables in the square are their tensor products. Derivatives and
// values at all points of a cell cost degree^3 operations instead of degree^4 (sum factorisation), and so does tying
// (M22).
#pragma once
#include <plastron/fem/basis.hpp>

namespace plastron::element {

/// A row per point, a column per node of the Gauss-Lobatto rule (of the reduced Gauss rule for `from_reduced`).
struct LineTables {
  fem::LagrangeTable full;       ///< at the degree + 1 Gauss points
  fem::LagrangeTable reduced;    ///< at the `degree` Gauss points where tying samples
  Eigen::MatrixXd from_reduced;  ///< interpolation from the reduced to the full Gauss points
};

LineTables line_tables(int degree);

}  // namespace plastron::element
