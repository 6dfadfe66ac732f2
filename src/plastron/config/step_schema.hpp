// The declarations of [[step]].
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

std::vector<Section> step_sections();

}  // namespace plastron::config
