// A triangle surface with no more triangles than a drawing needs: vertices that share a box of a grid become one (Rossignac and Borrel's
// vertex clustering).
#pragma once
#include <plastron/obstacle/triangle_mesh.hpp>

namespace plastron::io {

/// The surface itself if it has at most `most` triangles, else one on the finest of the grids of 96, 48, 24, 12 boxes along its longest side
/// that has as few. A box's vertex is the first of the surface's own that lies in it, so that drawn points are on the surface.
obstacle::TriangleMesh thinned_surface(const obstacle::TriangleMesh& surface, std::size_t most);

}  // namespace plastron::io
