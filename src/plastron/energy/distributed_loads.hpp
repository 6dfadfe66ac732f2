// Nodal forces of loads per area and per length: integrals over cells and sides, also inside cells that a load covers in part.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/energy/shell_operator.hpp>

namespace plastron::energy {

/// Returns the forces of the loads on areas and edges and of the weight, six values for each node (collective). `is_spot`: the loads
/// act inside one spot, and the caller puts their sums right, so a coarse rule is enough. Throws LoadError on all ranks together for
/// a load that is not finite, that names an unknown place, or, unless it is a spot, that acts nowhere.
algebra::Vector distributed_forces(const ShellOperator& shell, const Loads& loads, bool is_spot = false);

}  // namespace plastron::energy
