// Bytes as text, by OpenSSL: SHA-256 to detect changes of files, and base64 to embed numbers in text files.
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// Size and hash of a file. They do not protect against a person who changes a file and its hash.
struct Checksum {
  std::uintmax_t bytes = 0;
  std::string hash{};  ///< 64 hexadecimal digits
  bool operator==(const Checksum&) const = default;
};

Checksum checksum_of_text(std::string_view text);
/// Returns the checksum. Throws std::runtime_error where there is no regular file or it cannot be read.
Checksum checksum_of_file(const std::filesystem::path& path);

/// Returns the bytes in the standard alphabet of base64, with padding.
std::string base64(std::span<const std::byte> bytes);
std::string base64(const std::string& bytes);

static_assert(std::endian::native == std::endian::little, "pages hold little-endian numbers");
/// Returns the numbers, each in its little-endian bytes, as base64.
template <class Number>
std::string base64_of_numbers(const std::vector<Number>& numbers) {
  return base64(std::as_bytes(std::span(numbers.data(), numbers.size())));
}

}  // namespace plastron::io
