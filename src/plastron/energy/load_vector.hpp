// The load functional l of (M9) as Cartesian nodal forces.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/energy/shell_operator.hpp>

#include <vector>

namespace plastron::energy {

using geometry::Vector3d;

/// Returns nodal forces and couples, six values for each node, complete on owned nodes (collective). Area loads name
/// regions of the mesh, edge loads name boundaries. Loads of the space's rigid bodies are included. So is the weight
/// rho e g of the cross-sections. Loads made of
/// pieces (geometry::is_piecewise) are integrated between the borders of the pieces, even if these are narrow. Throws LoadError on all ranks together.
algebra::Vector load_vector(const ShellOperator& shell, const Loads& loads);

/// Loads that have one factor, at factor 1.
struct LoadPart {
  int factor = -1;                          ///< see Factors::named
  algebra::Vector forces;                   ///< on the undeformed shell, like load_vector()
  bool follows = false;                     ///< whether some of them follow the shell, on any rank
  std::vector<Eigen::VectorXd> pressure{};  ///< see follower_pressure.hpp
};
/// Returns the loads by their factors (collective). Throws LoadError on all ranks together.
std::vector<LoadPart> load_parts(const ShellOperator& shell, const Loads& loads);

/// Returns the forces of initial strains, int N_0 : gamma(v) + M_0 : chi(v, s), on the undeformed shell (collective). Throws LoadError
/// where a temperature is not finite.
algebra::Vector initial_forces(const ShellOperator& shell, const Factors& factors);

}  // namespace plastron::energy
