// Triangles that the remeshing turned over: at features smaller than the triangles, and at curves with many short sides.
#pragma once
#include <plastron/facets/remesh.hpp>

namespace plastron::facets {

/// Changes triangles where two of one smooth face fold back onto each other: their common side is turned, a corner moves to
/// the middle of its neighbours or onto one of them. Corners on curves stay. What cannot be mended remains.
void untangle(Remeshed& mesh);

}  // namespace plastron::facets
