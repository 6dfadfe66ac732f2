// Edges that lie on each other in space and are joined there: nodes of both become one. So a rectangle is closed to a tube,
// and pieces with a chart of their own make one shell.
#pragma once
#include <plastron/fem/surface.hpp>

#include <array>
#include <string>
#include <vector>

namespace plastron::fem {

/// Two boundaries of the mesh.
struct Join {
  std::array<std::string, 2> boundaries;
};

/// The space with the nodes on joined edges tied to one of them each (collective). Throws DomainError on all ranks where a
/// boundary is not there, where a node has no partner at the same place, or where normals point to opposite sides. Shells that meet at an
/// angle turn together about their edge alone, see kinks.hpp.
std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins);

}  // namespace plastron::fem
