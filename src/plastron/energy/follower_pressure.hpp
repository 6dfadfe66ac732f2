// Pressure that follows the shell with finite rotations: the force p y_1 x y_2 dx acts on the deformed mid-surface, along its normal
// and on its area. Its derivative is symmetric up to terms on edges where the pressed part of the shell is free to move: there
// only the symmetric part enters the stiffness (docs/methods/finite-rotations.md).
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/energy/shell_operator.hpp>

#include <Eigen/Core>
#include <vector>

namespace plastron::energy {

/// Returns pressure times quadrature weight at the quadrature points of owned cells, with the sign of a_1 x a_2 along the normal;
/// empty for cells on which no load follows, and as a whole where none does anywhere. Throws LoadError on this rank alone.
std::vector<Eigen::VectorXd> follower_pressure(const ShellOperator& shell, const Loads& loads);

/// Returns the nodal forces of the pressure at the place (u, r) = y less those on the undeformed shell, complete on owned nodes
/// (collective).
algebra::Vector change_of_follower_forces(const ShellOperator& shell, const std::vector<Eigen::VectorXd>& pressure,
                                          const algebra::Vector& y);

/// Returns the symmetric part of minus the derivative of a cell's forces, on (u, r) of its nodes, at its deformed geometry.
RowMatrix follower_stiffness(const ShellOperator& shell, const Eigen::VectorXd& pressure, const CellGeometry& at);

}  // namespace plastron::energy
