// The load functional l of (M9) as Cartesian nodal forces.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/loads.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <vector>

namespace plastron::assembly {

/// Nodal forces and couples, six a node, complete on owned nodes (collective). Edge loads name boundaries of the mesh.
algebra::Vector load_vector(const ShellOperator& shell, const std::vector<AreaLoad>& area_loads,
                            const std::vector<EdgeLoad>& edge_loads);

}  // namespace plastron::assembly
