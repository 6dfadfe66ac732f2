// The load functional l of (M9) as Cartesian nodal forces.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/loads.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <stdexcept>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

/// A load that is infinite or not a number at a quadrature point, or that names a boundary or region which the mesh does not
/// have: in words for the user.
struct LoadError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Nodal forces and couples, six a node, complete on owned nodes (collective). Area loads name regions of the mesh, edge
/// loads boundaries; rigid bodies of the space bring their own. The weight rho e g of the cross-sections under the acceleration g [m/s^2] is added to the loads.
/// Loads made of pieces (geometry::is_piecewise) are integrated between the borders of the pieces, however narrow these are.
/// Throws LoadError on all ranks alike.
algebra::Vector load_vector(const ShellOperator& shell, const std::vector<AreaLoad>& area_loads,
                            const std::vector<EdgeLoad>& edge_loads, const Vector3d& gravity = Vector3d::Zero());

}  // namespace plastron::assembly
