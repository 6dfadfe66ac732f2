// The declarations of [[obstacle]], which has a table for each shape.
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

std::vector<Section> obstacle_sections();
/// A turn about a line, as the table at `path`.
Section rotate_section(const std::string& path);

}  // namespace plastron::config
