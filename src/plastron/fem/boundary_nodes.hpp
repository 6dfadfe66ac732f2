// The nodes on a boundary, known to all ranks, and layouts with additional ghosts. Constraints between distant
// nodes need both.
#pragma once
#include <plastron/fem/surface.hpp>

#include <set>
#include <string>
#include <vector>

namespace plastron::fem {

struct BoundaryNode {
  algebra::GlobalIndex node;
  Eigen::Vector3d place, normal, along;  ///< place phi [m], normal a_3, unit tangent of the edge in space
};

/// Returns the boundary's index. Throws DomainError "WHAT is not there" with `what` if no boundary has the name.
int boundary_index(const mesh::CoarseMesh& coarse, const std::string& name, const char* what);

/// Returns the nodes in ascending order, the same on every rank (collective).
std::vector<BoundaryNode> nodes_on(const Space& space, const Surface& surface, int boundary);

/// Returns the nodes of the edges of CoarseMesh::folds, by number of the edge (Space::fold_sides) and in ascending order,
/// the same on every rank (collective).
std::vector<std::vector<BoundaryNode>> fold_nodes(const Space& space, const Surface& surface);

/// Adds ghosts to the space; the owned nodes keep their numbers (collective).
void widen(Space& space, const std::set<algebra::GlobalIndex>& wanted);

}  // namespace plastron::fem
