#include <plastron/io/bytes.hpp>

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace plastron::io {

namespace {

class Sha256 {
 public:
  Sha256() {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) refuse();
  }
  void add(std::string_view text) {
    if (EVP_DigestUpdate(context_.get(), text.data(), text.size()) != 1) refuse();
    bytes_ += text.size();
  }
  Checksum checksum() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_DigestFinal_ex(context_.get(), digest.data(), &size) != 1) refuse();
    return {bytes_, fmt::format("{:02x}", fmt::join(digest.data(), digest.data() + size, ""))};
  }

 private:
  [[noreturn]] static void refuse() { throw std::runtime_error("OpenSSL cannot compute SHA-256"); }
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> context_{EVP_MD_CTX_new()};
  std::uintmax_t bytes_ = 0;
};

}  // namespace

Checksum checksum_of_text(std::string_view text) {
  Sha256 sum;
  sum.add(text);
  return sum.checksum();
}

Checksum checksum_of_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw std::runtime_error(fmt::format("{}: there is no such file", path.string()));
  std::ifstream file(path, std::ios::binary);
  Sha256 sum;
  std::string piece(1 << 16, '\0');
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sum.add(std::string_view(piece).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  if (file.bad() || !file.eof()) throw std::runtime_error(fmt::format("{}: the file cannot be read", path.string()));
  return sum.checksum();
}

std::string base64(std::span<const std::byte> bytes) {
  // OpenSSL counts with int. Every part but the last is a multiple of three bytes, so that none needs padding.
  constexpr std::size_t longest = 3 << 20;
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // OpenSSL adds a closing zero
  auto* place = reinterpret_cast<unsigned char*>(text.data());
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(longest, bytes.size())))
    place += EVP_EncodeBlock(place, reinterpret_cast<const unsigned char*>(bytes.data()),
                             static_cast<int>(std::min(longest, bytes.size())));
  text.pop_back();
  return text;
}

std::string base64(const std::string& bytes) { return base64(std::as_bytes(std::span(bytes.data(), bytes.size()))); }

}  // namespace plastron::io
