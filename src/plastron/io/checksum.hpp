// Size and SHA-256 of a file, to detect changes. They do not protect against a person who changes a file and its hash.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace plastron::io {

struct Checksum {
  std::uintmax_t bytes = 0;
  std::string hash{};  ///< 64 hexadecimal digits
  bool operator==(const Checksum&) const = default;
};

Checksum checksum_of_text(std::string_view text);
/// Returns the checksum. Throws std::runtime_error where there is no regular file or it cannot be read.
Checksum checksum_of_file(const std::filesystem::path& path);

}  // namespace plastron::io
