// Coordinates of nodes that keep only a part of their own values: nodes of rigid bodies and nodes at kinks.
#pragma once
#include <plastron/assembly/node_coordinates.hpp>

namespace plastron::assembly {

/// Returns the coordinates of an owned node that space.constraints constrains, without contact rows. `support` contains
/// the node's rows after move_to_free_nodes().
///
/// A node that follows from others has no basis, and its coordinates are fixed at zero. A node at a kink has the
/// rotations that the kink leaves to it. Where a node stores unknowns of its body, its three displacement coordinates
/// are these unknowns. Their bounds are equal where the body is fixed. Elsewhere the displacement coordinates are fixed
/// at zero and move nothing. Supports of the node may repeat the components that its body prescribes, and may fix
/// rotations that a hinge leaves free. Throws SupportError where they prescribe more.
NodeCoordinates constrained_coordinates(const fem::Space& space, algebra::LocalIndex node, const NodalPoint& point,
                                        const NodeSupport& support, double size);

}  // namespace plastron::assembly
