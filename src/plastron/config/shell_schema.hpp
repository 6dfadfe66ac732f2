// The declarations of [shell], [[region]] and [gravity]: the cross-sections of the shell, and its weight.
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

std::vector<Section> shell_sections();

}  // namespace plastron::config
