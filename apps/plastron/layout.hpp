// Text for a terminal of 100 columns: paragraphs, and rows of a label with what it stands for.
#pragma once
#include <string>
#include <string_view>

namespace plastron::app {

inline constexpr std::size_t text_width = 100;

/// Number of characters, not of bytes.
std::size_t characters(std::string_view text);

/// Broken at blanks, every line indented; ends in a line break.
std::string paragraph(std::string_view text, std::size_t indent = 0);
/// The label, then the text as a paragraph beside it, or below if the label is wider than `label_width`.
std::string row(std::string_view label, std::size_t label_width, std::string_view text, std::size_t indent = 2);

}  // namespace plastron::app
