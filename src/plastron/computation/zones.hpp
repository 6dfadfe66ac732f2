// The contact zones of a finished result, and how well their edges are known.
#pragma once
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Of each obstacle of the solution, into the summary (collective).
void add_contact_zones(Result& result);

/// How far the edges of contact zones are from those of another solution, over the zones' size (certificate::relative_distance): of the obstacle
/// where that is most. Obstacles that no cell touches with all its nodes do not count, for contact along a line has no width to find.
/// (collective)
double edge_change(const Solution& one, const Solution& other);

}  // namespace plastron::computation
