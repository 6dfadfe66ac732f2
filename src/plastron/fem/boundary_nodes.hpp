// The nodes on a boundary, known to all ranks, and a layout that has further ghosts: what ties between far nodes are made with.
#pragma once
#include <plastron/fem/surface.hpp>

#include <set>
#include <string>
#include <vector>

namespace plastron::fem {

struct BoundaryNode {
  algebra::GlobalIndex node;
  Eigen::Vector3d place, normal, along;  ///< phi [m], a_3, unit tangent of the edge in space
};

/// Throws DomainError that says what is on no boundary: "WHAT is not there".
int boundary_index(const CoarseMesh& coarse, const std::string& name, const char* what);

/// Ascending, the same on every rank (collective).
std::vector<BoundaryNode> nodes_on(const Space& space, const Surface& surface, int boundary);

/// The space with further ghosts; the owned nodes keep their numbers (collective).
void widen(Space& space, const std::set<algebra::GlobalIndex>& wanted);

}  // namespace plastron::fem
