// Arrows that show the loads in the three-dimensional view of report.html.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/quantities.hpp>

namespace plastron::report {

/// Returns the places of arrows, the displacements there and the directions of the loads, unit vectors, in base64. The weakest loads
/// have no arrow (collective).
io::Json loads_json(const computation::Solution& solution);

}  // namespace plastron::report
