#include <plastron/io/checksum.hpp>

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <string_view>

namespace plastron::io {

namespace {

class Fnv1a {
 public:
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    bytes_ += text.size();
  }
  Checksum checksum() const { return {bytes_, fmt::format("fnv1a64:{:016x}", value_)}; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
  std::uintmax_t bytes_ = 0;
};

}  // namespace

Checksum checksum_of_text(const std::string& text) {
  Fnv1a sum;
  sum.add(text);
  return sum.checksum();
}

Checksum checksum_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: there is no such file", path.string()));
  std::ifstream file(path, std::ios::binary);
  Fnv1a sum;
  std::string piece(1 << 16, '\0');
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sum.add(std::string_view(piece).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  if (file.bad() || !file.eof()) throw std::runtime_error(fmt::format("{}: the file cannot be read", path.string()));
  return sum.checksum();
}

}  // namespace plastron::io
