// The declarations of [[obstacle]], which has a table for each shape.
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

std::vector<Section> obstacle_sections();

}  // namespace plastron::config
