// A triangle surface reduced for drawing: vertices in the same box of a grid become one (Rossignac and Borrel's
// vertex clustering).
#pragma once
#include <plastron/obstacle/triangle_mesh.hpp>

namespace plastron::io {

/// Returns the surface itself if it has at most `most` triangles. Otherwise returns a coarser one on the finest
/// possible grid of 96, 48, 24 or 12 boxes along its longest side. A box's vertex is the first of the surface's own
/// vertices in it, so that drawn points are on the surface.
obstacle::TriangleMesh thinned_surface(const obstacle::TriangleMesh& surface, std::size_t most);

}  // namespace plastron::io
