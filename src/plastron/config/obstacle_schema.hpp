// The declarations of [[obstacle]], which has a table for each shape.
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

std::vector<Section> obstacle_sections();
/// Returns the declaration of a rotation about a line, for the table at `path`.
Section rotate_section(const std::string& path);

}  // namespace plastron::config
