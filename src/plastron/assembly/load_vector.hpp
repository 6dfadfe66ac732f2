// The load functional l of (M9) as Cartesian nodal forces.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/loads.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <stdexcept>

namespace plastron::assembly {

using geometry::Vector3d;

/// Error of a load, in words for the user: the load is infinite or not a number at a quadrature point, or names a
/// boundary or region that the mesh does not have.
struct LoadError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Returns nodal forces and couples, six values for each node, complete on owned nodes (collective). Area loads name
/// regions of the mesh, edge loads name boundaries. Loads of the space's rigid bodies are included. So is the weight
/// rho e g of the cross-sections, and the load of initial strains, int N_0 : gamma(v) + M_0 : chi(v, s). Loads made of
/// pieces (geometry::is_piecewise) are integrated between the borders of the pieces, even if these are narrow. Throws LoadError on all ranks together.
algebra::Vector load_vector(const ShellOperator& shell, const Loads& loads);

/// Returns the part of the load vector that initial strains cause, on the undeformed shell (collective).
algebra::Vector initial_forces(const ShellOperator& shell);

}  // namespace plastron::assembly
