// Text for a terminal of 100 columns: paragraphs, and rows of a label with its explanation.
#pragma once
#include <string>
#include <string_view>

namespace plastron::app {

inline constexpr std::size_t text_width = 100;

/// Number of characters, not of bytes.
std::size_t characters(std::string_view text);

/// Returns the text broken at blanks, with every line indented and a final line break.
std::string paragraph(std::string_view text, std::size_t indent = 0);
/// Returns the label with the text as a paragraph beside it, or below it if the label is wider than `label_width`.
std::string row(std::string_view label, std::size_t label_width, std::string_view text, std::size_t indent = 2);

}  // namespace plastron::app
