// Coordinates of nodes that are carried (fem/carried_nodes.hpp): those of the rigid bodies' motions, and rotations that hinges leave free.
#pragma once
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/fem/carried_nodes.hpp>

namespace plastron::assembly {

/// Of an owned node, rows not set. Where a kink carries the node, `support` holds what is left of its rotation (kinked_supports.hpp).
///
///  Where the node keeps unknowns of its body, its displacements are they: three coordinates, with equal
/// bounds where the body is fixed; elsewhere they are held at zero and move nothing. Supports of the node may say of the body what is
/// prescribed of it already, and hold rotations that a hinge leaves free; throws SupportError where they say more.
NodeCoordinates carried_coordinates(const fem::CarriedNodes& carried, const fem::CarriedNode& node,
                                    const NodalPoint& point, const NodeSupport& support, double size);

}  // namespace plastron::assembly
