// Seams: parts of the domain's boundary that coincide in space though the mesh does not join them. The shell is slit
// there. Example: the two edges of a sheet that the chart rolls to a tube.
#pragma once
#include <plastron/fem/space.hpp>
#include <plastron/fem/surface.hpp>

#include <string>
#include <vector>

namespace plastron::examination {

/// Returns one warning for each pair of boundaries, with a place. `space` is a whole mesh on one process. Sides of its
/// cells are compared as a whole.
std::vector<std::string> seam_warnings(const fem::Space& space, const fem::Surface& surface);

}  // namespace plastron::examination
