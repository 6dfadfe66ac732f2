// The version of Plastron that results name; a test compares it with the build's.
#pragma once
#include <string_view>

namespace plastron::io {

inline constexpr std::string_view version = "0.1.0";

}  // namespace plastron::io
