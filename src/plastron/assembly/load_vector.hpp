// The load functional l of (M9) as Cartesian nodal forces.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/assembly/loads.hpp>
#include <plastron/assembly/shell_operator.hpp>

#include <stdexcept>
#include <vector>

namespace plastron::assembly {

struct LoadError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Nodal forces and couples, six a node, complete on owned nodes (collective). Throws LoadError for an
/// edge load on a boundary that the mesh does not have.
algebra::Vector load_vector(const ShellOperator& shell, const std::vector<AreaLoad>& area_loads,
                            const std::vector<EdgeLoad>& edge_loads);

}  // namespace plastron::assembly
