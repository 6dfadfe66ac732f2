#include "layout.hpp"

#include <sstream>

namespace plastron::app {

std::size_t characters(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++count;
  return count;
}

namespace {

/// Returns words from column `column` on; further lines begin at `indent`.
std::string filled(std::string_view text, std::size_t column, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result, word;
  bool is_first = true;
  while (words >> word) {
    const std::size_t length = characters(word);
    if (!is_first && column + 1 + length > text_width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
      is_first = true;
    }
    if (!is_first) result += ' ';
    result += word;
    column += length + (is_first ? 0 : 1);
    is_first = false;
  }
  return result;
}

}  // namespace

std::string paragraph(std::string_view text, std::size_t indent) {
  return std::string(indent, ' ') + filled(text, indent, indent) + "\n";
}

std::string row(std::string_view label, std::size_t label_width, std::string_view text, std::size_t indent) {
  const std::size_t column = indent + label_width + 1, length = characters(label);
  std::string line = std::string(indent, ' ') + std::string(label);
  if (text.empty()) return line + "\n";
  line += length > label_width ? "\n" + std::string(column, ' ') : std::string(column - indent - length, ' ');
  return line + filled(text, column, column) + "\n";
}

}  // namespace plastron::app
