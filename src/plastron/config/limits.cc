#include <fmt/format.h>
#include <plastron/config/limits.hpp>

#include <array>
#include <string_view>

namespace plastron::config {

namespace {

bool is_quote(char c) { return c == '"' || c == '\''; }

/// Returns the end of a comment or a string that begins at `at`: the first character after it. A string on one line
/// without closing quote ends with its line.
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

void check_shape(const Source& source) {
  const std::string_view text = source.text();
  const auto refuse = [&](std::size_t at, const std::string& what) {
    throw CaseErrors({source.mistake({at, 1}, what, "", "no case needs as much")});
  };
  const auto check_depth = [&](std::size_t at, std::size_t deep, const char* what) {
    if (deep > deepest_nesting) refuse(at, fmt::format("{} nested deeper than {}", what, deepest_nesting));
  };
  std::size_t depth = 0, parts = 0, sections = 0;
  std::array<std::size_t, deepest_nesting + 1> entries{};  // number so far at each depth; at depth 0 in the section
  const auto count_entry = [&](std::size_t at) {
    if (++entries[depth] > most_entries)
      refuse(at, fmt::format("a list or table of more than {} entries", most_entries));
  };
  char before = '\n';  // the last character that is not a blank
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '#' || is_quote(c)) {
      i = after_token(text, i);
      if (c != '#') before = c;
      continue;
    }
    if (c == '[' && depth == 0 && before == '\n') {
      entries[0] = 0;
      if (++sections > most_entries) refuse(i, fmt::format("more than {} sections", most_entries));
    }
    if (c == '[' || c == '{') {
      check_depth(i, ++depth, "lists or tables are");
      entries[depth] = 0;
    }
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if ((c == ',' && depth > 0) || (c == '=' && depth == 0)) count_entry(i);
    if (c == '.') check_depth(i, ++parts, "the parts of a key are");
    if (c != ' ' && c != '\t' && c != '\r') before = c;
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
