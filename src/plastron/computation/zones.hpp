// The contact zones of a finished result, and the accuracy of their edges.
#pragma once
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Adds the contact zones of each obstacle to the summary (collective).
void add_contact_zones(Result& result);

/// Returns the distance between the edges of contact zones of two solutions, relative to the zones' size
/// (certificate::relative_distance). It is the largest of all obstacles. Contact along a line has no edge. Therefore
/// obstacles without a cell whose nodes all touch are ignored. Zones narrower than half of the thickness, the width of
/// the layer at an edge, are ignored too. (collective)
double edge_change(const Solution& one, const Solution& other, double least_thickness);

}  // namespace plastron::computation
