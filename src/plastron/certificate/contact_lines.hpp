// Segments put together to polylines, in an order that depends on places alone.
#pragma once
#include <plastron/certificate/boundary_segments.hpp>

#include <vector>

namespace plastron::certificate {

/// The polylines of one zone: inside the shell first, then along the rim; long before short. Where a line crosses a joined edge it has
/// the same place twice, with the parameters of either side. `size`: of the shell [m].
std::vector<ContactLine> contact_lines(const std::vector<Segment>& segments, double size);

}  // namespace plastron::certificate
