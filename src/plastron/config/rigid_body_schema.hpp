// The declarations of [[rigid_body]].
#pragma once
#include <plastron/config/schema.hpp>

namespace plastron::config {

Section rigid_body_section();

}  // namespace plastron::config
