// The declaration of [output].
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

Section output_section();

}  // namespace plastron::config
