// The contact zones of a finished result, and how well their edges are known.
#pragma once
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Of each obstacle of the solution, into the summary (collective).
void add_contact_zones(Result& result);

/// How far the edges of contact zones are from those of another solution, over the zones' size (certificate::relative_distance): of the obstacle
/// where that is most. Contact along a line has no edge to find: neither obstacles that no cell touches with all its nodes nor zones narrower than
/// half of the thickness count, which is how wide the layer at an edge is. (collective)
double edge_change(const Solution& one, const Solution& other, double least_thickness);

}  // namespace plastron::computation
