// The declarations of [geometry], which has tables in tables.
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

/// Returns the range of all numbers greater than 0.
inline Range positive() { return {.low = 0, .low_open = true}; }

std::vector<Section> geometry_sections();

}  // namespace plastron::config
