// Size and hash of a file, to notice that it is not the one it was. FNV-1a (Fowler, Noll, Vo 1991) finds accidents, not
// malice: who changes a file with intent could write another hash as well.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace plastron::io {

struct Checksum {
  std::uintmax_t bytes = 0;
  std::string hash{};  ///< "fnv1a64:" and sixteen hexadecimal digits
  bool operator==(const Checksum&) const = default;
};

Checksum checksum_of_text(const std::string& text);
/// Throws std::runtime_error where the file cannot be read.
Checksum checksum_of_file(const std::filesystem::path& path);

}  // namespace plastron::io
