// Reads base64 back, for tests of pages.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace plastron::report {

inline std::string decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = (word << 6U) | static_cast<std::uint32_t>(letters.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>((word >> static_cast<unsigned>(bits -= 8)) & 255U);
  }
  return bytes;
}

template <class Number>
std::vector<Number> decoded_numbers(const std::string& text) {
  const std::string bytes = decoded(text);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

}  // namespace plastron::report
