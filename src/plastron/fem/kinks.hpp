// Shells joined at an angle. They share the displacement of the edge and one rotation vector omega, r_i = omega x a_3i. No shell knows
// the part of omega along its own normal, so what two of them share of it is omega . t, t the edge's tangent:
//   u_2 = u_1,   r_2 . (t x a_32) = r_1 . (t x a_31).
// The node of the second is carried by that of the first (carried_nodes.hpp) and keeps r_2 . t as its own.
#pragma once
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/carried_nodes.hpp>

#include <map>
#include <optional>
#include <vector>

namespace plastron::fem {

/// Two nodes in one place whose normals differ.
struct Kink {
  std::array<BoundaryNode, 2> nodes;
};

/// A carried node as all ranks know it.
struct KinkedNode {
  Matrix6 own = Matrix6::Zero();
  std::vector<std::pair<algebra::GlobalIndex, Matrix6>> carriers{};  ///< the first decides u
};

/// Of all nodes that are carried, by number. Kinks that hang together are gone through from their smallest node. Throws DomainError where a
/// node would have to turn with more than two others about different tangents.
std::map<algebra::GlobalIndex, KinkedNode> kinked_nodes(const std::vector<Kink>& kinks);

/// The nodes whose values follow from others' by a kink, not by a rigid body.
bool is_kinked(const CarriedNodes& carried, const CarriedNode& node);

/// Adds each kinked node's value to the node that decides its u, and leaves it zero: for scalar fields (collective where nodes are carried).
void collect_at_kinks(const Space& space, algebra::Vector& values);

}  // namespace plastron::fem
