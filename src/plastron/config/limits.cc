#include <fmt/format.h>
#include <plastron/config/limits.hpp>

#include <algorithm>
#include <string_view>

namespace plastron::config {

namespace {

bool is_quote(char c) { return c == '"' || c == '\''; }

/// Where a comment or a string that begins at `at` ends: the first character after it. A string on one line that is never
/// closed ends with its line.
std::size_t after_token(std::string_view text, std::size_t at) {
  const auto end_or = [&](std::size_t found, std::size_t length) {
    return found == std::string_view::npos ? text.size() : found + length;
  };
  if (text[at] == '#') return end_or(text.find('\n', at), 0);
  const char quote = text[at];
  const std::string three(3, quote);
  const bool many_lines = text.substr(at, 3) == three;
  std::size_t i = at + (many_lines ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\')
      ++i;
    else if (many_lines && text.substr(i, 3) == three)
      return i + 3;
    else if (!many_lines && (text[i] == quote || text[i] == '\n'))
      return text[i] == quote ? i + 1 : i;
  }
  return text.size();
}

}  // namespace

void check_nesting(const Source& source) {
  const std::string_view text = source.text();
  const auto refuse = [&](std::size_t at, const char* what) {
    throw CaseErrors({source.mistake({at, 1}, fmt::format("{} nested deeper than {}", what, deepest_nesting), "",
                                     "no case needs more than a few levels")});
  };
  std::size_t depth = 0, parts = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#' || is_quote(c)) {
      i = after_token(text, i);
      continue;
    }
    if ((c == '[' || c == '{') && ++depth > deepest_nesting) refuse(i, "lists or tables are");
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (c == '.' && ++parts > deepest_nesting) refuse(i, "the parts of a key are");
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) parts = 0;
    ++i;
  }
}

void check_counts(const Source& source, const toml::value& value) {
  const auto check = [&](std::size_t count, const char* what) {
    if (count > most_entries)
      throw CaseErrors({source.mistake(source.value(value), fmt::format("{} of {} entries", what, count),
                                       fmt::format("at most {} entries", most_entries))});
  };
  if (value.is_array()) {
    check(value.as_array().size(), "a list");
    for (const toml::value& entry : value.as_array()) check_counts(source, entry);
  } else if (value.is_table()) {
    check(value.as_table().size(), "a table");
    for (const auto& [name, entry] : value.as_table()) check_counts(source, entry);
  }
}

}  // namespace plastron::config
