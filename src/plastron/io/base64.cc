#include <plastron/io/base64.hpp>

#include <deal.II/base/utilities.h>

namespace plastron::io {

std::string base64(std::span<const std::byte> bytes) {
  const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
  return dealii::Utilities::encode_base64({first, first + bytes.size()});
}

std::string base64(const std::string& bytes) { return base64(std::as_bytes(std::span(bytes.data(), bytes.size()))); }

}  // namespace plastron::io
