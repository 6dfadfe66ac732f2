// Fields brought into the discrete K (M17) or V (M10) of a mesh, node by node.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

namespace plastron::study {

/// The field of K_h whose nodal coordinates (assembly/nodal_coordinates.hpp) are those of `y` moved to the nearest bound where they are
/// outside: gaps that are negative are closed, supports kept, r made tangent. For a field of K_h it is the same. Block 6 with valid
/// ghosts; y is not read where nodes are tied. Precondition: no rigid bodies, and no relaxed formulation. (collective)
algebra::Vector nearest_admissible(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// The part in V_h of a difference of fields: zero at supports, r tangent. Same precondition. (collective)
algebra::Vector virtual_part(const assembly::DiscreteShell& discrete, const algebra::Vector& difference);

}  // namespace plastron::study
