// Text of unknown origin made fit for a terminal. Control characters could move its cursor, change its colours, rename its
// window or make one message look like another.
#pragma once
#include <string>
#include <string_view>

namespace plastron::config {

enum class LineBreaks { replace, keep };

/// Every control character (C0 but the tab, DEL, C1), every sign that turns the direction of writing, and every byte that
/// is no UTF-8 becomes a question mark; line breaks do so unless they are kept.
std::string printable(std::string_view text, LineBreaks breaks = LineBreaks::replace);

/// Whether there is anything in it that printable() would replace, or a tab.
bool has_control_characters(std::string_view text);

/// Bytes of the UTF-8 code point that begins at `at`, 0 if it is none.
std::size_t code_point_length(std::string_view text, std::size_t at);

}  // namespace plastron::config
