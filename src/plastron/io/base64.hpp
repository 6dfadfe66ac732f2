// Converts bytes to text, in the standard alphabet of base64 with padding.
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace plastron::io {

std::string base64(std::span<const std::byte> bytes);
std::string base64(const std::string& bytes);

}  // namespace plastron::io
