// Coordinates of carried nodes (fem/constraints.hpp): the motions of rigid bodies, and the rotations that hinges
// leave free.
#pragma once
#include <plastron/assembly/node_coordinates.hpp>
#include <plastron/fem/constraints.hpp>

namespace plastron::assembly {

/// Returns the coordinates of an owned node, without contact rows. Where a kink carries the node, `support` contains
/// the remaining rows on its rotation (kinked_supports.hpp).
///
/// Where the node keeps unknowns of its body, its three displacement coordinates are these unknowns. Their bounds are
/// equal where the body is fixed. Elsewhere the displacement coordinates are fixed at zero and move nothing. Supports
/// of the node may repeat the components that its body prescribes, and may fix rotations that a hinge leaves free.
/// Throws SupportError where they prescribe more.
NodeCoordinates carried_coordinates(const fem::CarriedNodes& carried, const fem::CarriedNode& node,
                                    const NodalPoint& point, const NodeSupport& support, double size);

}  // namespace plastron::assembly
