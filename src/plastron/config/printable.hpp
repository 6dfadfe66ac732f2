// Makes text of unknown origin safe for a terminal. Control characters could move its cursor, change its colours,
// rename its window or make one message look like another.
#pragma once
#include <string>
#include <string_view>

namespace plastron::config {

enum class LineBreaks { replace, keep };

/// Replaces by a question mark every control character (C0 except the tab, DEL, C1), every sign that changes the
/// direction of writing, and every byte that is not UTF-8. Line breaks are replaced too unless they are kept.
std::string printable(std::string_view text, LineBreaks breaks = LineBreaks::replace);

/// Whether the text contains a character that printable() would replace, or a tab.
bool has_control_characters(std::string_view text);

/// Number of bytes of the UTF-8 code point that begins at `at`, 0 if there is none.
std::size_t code_point_length(std::string_view text, std::size_t at);

}  // namespace plastron::config
