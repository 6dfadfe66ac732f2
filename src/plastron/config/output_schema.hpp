// The declarations of [output] and [units].
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

Section output_section();
Section units_section();

}  // namespace plastron::config
