#include <plastron/config/printable.hpp>

namespace plastron::config {

namespace {

/// Whether it is U+2028 to U+202E or U+2066 to U+2069: line separators and directions of writing.
bool turns_the_line(std::string_view code_point) {
  if (code_point.size() != 3 || code_point[0] != '\xE2') return false;
  const auto second = static_cast<unsigned char>(code_point[1]), third = static_cast<unsigned char>(code_point[2]);
  return (second == 0x80 && third >= 0xA8 && third <= 0xAE) || (second == 0x81 && third >= 0xA6 && third <= 0xA9);
}

bool is_control(std::string_view code_point) {
  const auto first = static_cast<unsigned char>(code_point[0]);
  if (code_point.size() == 1) return first < 0x20 || first == 0x7F;
  return (code_point.size() == 2 && first == 0xC2 && static_cast<unsigned char>(code_point[1]) < 0xA0) ||
         turns_the_line(code_point);
}

}  // namespace

std::size_t code_point_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(at), second = byte(at + 1);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool surrogate = first == 0xED && second > 0x9F, too_large = first == 0xF4 && second > 0x8F;
  return overlong || surrogate || too_large ? 0 : length;
}

bool has_control_characters(std::string_view text) {
  return text.find('\t') != std::string_view::npos || printable(text) != text;
}

std::string printable(std::string_view text, LineBreaks breaks) {
  std::string clean;
  clean.reserve(text.size());
  for (std::size_t i = 0, length = 0; i < text.size(); i += length) {
    length = code_point_length(text, i);
    const bool kept = text[i] == '\t' || (text[i] == '\n' && breaks == LineBreaks::keep);
    if (kept || (length > 0 && !is_control(text.substr(i, length))))
      clean += text.substr(i, length);
    else
      clean += '?';
    if (length == 0) length = 1;
  }
  return clean;
}

}  // namespace plastron::config
