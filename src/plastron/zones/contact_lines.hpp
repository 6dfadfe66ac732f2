// Polylines joined from segments, in an order that depends only on their places.
#pragma once
#include <plastron/zones/boundary_segments.hpp>

#include <vector>

namespace plastron::zones {

/// Returns the polylines of one zone: inside the shell first, then along the rim; long before short. Where a line
/// crosses a joined edge, it has the same place twice, with the parameters of either side. `size`: size of the shell
/// [m].
std::vector<solution::ContactLine> contact_lines(const std::vector<Segment>& segments, double size);

}  // namespace plastron::zones
