// Shells joined at an angle. They share the displacement of the edge and one rotation vector omega, r_i = omega x
// a_3i. A shell's rotation does not contain the part of omega along its own normal. Therefore two shells share only
// omega . t, t the edge's tangent:
//   u_2 = u_1,   r_2 . (t x a_32) = r_1 . (t x a_31).
// The node of the second shell is carried by the node of the first (carried_nodes.hpp) and keeps r_2 . t as its own
// coordinate.
#pragma once
#include <plastron/fem/boundary_nodes.hpp>
#include <plastron/fem/carried_nodes.hpp>

#include <map>
#include <optional>
#include <vector>

namespace plastron::fem {

/// Two nodes at the same place with different normals.
struct Kink {
  std::array<BoundaryNode, 2> nodes;
};

/// A carried node as known to all ranks.
struct KinkedNode {
  Matrix6 own = Matrix6::Zero();
  std::vector<std::pair<algebra::GlobalIndex, Matrix6>> carriers{};  ///< the first one determines u
};

/// Returns all carried nodes by number. Connected kinks are processed from their smallest node. Throws DomainError if
/// a node would have to turn with more than two others about different tangents.
std::map<algebra::GlobalIndex, KinkedNode> kinked_nodes(const std::vector<Kink>& kinks);

/// Whether a node is carried across a kink and not by a rigid body.
bool is_kinked(const CarriedNodes& carried, const CarriedNode& node);

/// Adds each kinked node's value to the node that determines its u, and sets it to zero. For scalar fields
/// (collective if any rank has carried nodes).
void collect_at_kinks(const Space& space, algebra::Vector& values);

}  // namespace plastron::fem
