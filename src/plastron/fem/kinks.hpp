// Kinks: nodes of different shells, or of different sides of a fold, that lie in one place. They share u and, without a hinge, the
// rotation about the edge (fem/constraints.hpp).
#pragma once
#include <plastron/fem/boundary_nodes.hpp>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace plastron::fem {

/// Two nodes at the same place with different normals. `along` of both is the axis about which they turn together. At a hinge they
/// share u alone, and the normals may be equal.
struct Kink {
  std::array<BoundaryNode, 2> nodes;
  bool is_hinge = false;
};

/// The row of a node at a kink, as known to all ranks.
struct KinkedNode {
  Matrix6 own = Matrix6::Zero();
  std::vector<std::pair<algebra::GlobalIndex, Matrix6>> sources{};  ///< other nodes; the first one determines u
};

struct ExpressedKinks {
  std::map<algebra::GlobalIndex, KinkedNode> nodes{};  ///< all nodes with a row by number
  /// The kinks by which the second nodes are expressed; the first ones are expressed by earlier kinks. A node has at most two, in
  /// sequence.
  std::vector<Kink> sequence{};
};

/// Expresses the nodes of connected kinks by each other, beginning with the smallest node. Throws DomainError if a node
/// would have to turn with more than two others about different tangents.
ExpressedKinks expressed(const std::vector<Kink>& kinks);

/// Returns the row of a local node, whose sources are local too.
constraints::Row row_of(const algebra::Layout& layout, algebra::LocalIndex node, const KinkedNode& kinked);

}  // namespace plastron::fem
