// The version of Plastron in results; a test compares it with the version of the build.
#pragma once
#include <string_view>

namespace plastron::io {

inline constexpr std::string_view version = "0.1.0";

}  // namespace plastron::io
