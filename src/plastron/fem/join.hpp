// Joined edges: edges that coincide in space are joined by identifying their nodes. A rectangle is closed to a tube
// this way, and pieces with separate charts form one shell.
#pragma once
#include <plastron/fem/surface.hpp>

#include <array>
#include <string>
#include <vector>

namespace plastron::fem {

/// Two boundaries of the mesh to be joined.
struct Join {
  std::array<std::string, 2> boundaries;
};

/// Returns the space in which the nodes on joined edges are tied to one node of each place (collective). Throws
/// DomainError on all ranks if a boundary does not exist, if a node has no partner at the same place, or if normals
/// are opposite. Shells that meet at an angle share only the rotation about their edge, see kinks.hpp.
std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins);

}  // namespace plastron::fem
