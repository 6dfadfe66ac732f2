// Fields of a fine mesh in the space of a coarse one: by their values at its nodes.
#pragma once
#include <plastron/assembly/shell_operator.hpp>

namespace plastron::study {

/// The values of the nodal field `y` of a finer, nested mesh at the nodes of `coarse`, block 6 with valid ghosts; y has valid ghosts.
/// Precondition: every cell of `fine` lies in one of `coarse`. (collective)
algebra::Vector values_at_nodes(const fem::Space& coarse, const assembly::ShellOperator& fine,
                                const algebra::Vector& y);

}  // namespace plastron::study
