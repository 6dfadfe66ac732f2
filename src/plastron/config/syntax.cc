// Reads the text as TOML within limits. Converts toml11's syntax errors of several lines to one sentence with one caret.
// Its message quotes the text as "12 | line" above a line with carets, several times when two places matter: at the
// last one reading stopped.
#include <fmt/format.h>
#include <plastron/config/schema.hpp>
#include <plastron/config/source.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string_view>

namespace plastron::config {

namespace {

// Returns the offset of the last caret of toml11's message.
std::size_t last_caret(const Source& source, const std::string& message, std::size_t otherwise) {
  std::istringstream lines(message);
  for (std::string line, carets; std::getline(lines, line);) {
    const std::size_t digit = line.find_first_not_of(' ');
    const std::size_t bar = line.find(" | ");
    if (digit == std::string::npos || digit == 0 || bar == std::string::npos || digit >= bar) continue;
    if (line.find_first_not_of("0123456789", digit) != bar || !std::getline(lines, carets)) continue;
    const std::size_t caret = carets.find_first_of("^~", bar + 3);
    if (caret != std::string::npos) otherwise = source.offset(std::stoul(line.substr(digit)), caret - bar - 2);
  }
  return otherwise;
}

std::string up_to(const std::string& text, std::size_t at, const char* ends) {
  return geometry::shortened(text.substr(at, text.find_first_of(ends, at) - at));
}

std::string quoted_name(const std::string& message) {
  const std::size_t begin = message.find("(\"") + 2;
  return geometry::shortened(message.substr(begin, message.find("\")", begin) - begin));
}

constexpr const char* key_letters = "a key has letters, digits, _ and -, and then comes =";

struct Sentence {
  std::string what, advice;
};

/// Returns advice on what follows a value: a unit, a decimal comma, or `otherwise`.
std::string after_value(const std::string& text, std::size_t at, const char* otherwise) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  const std::size_t next = std::min(text.find_first_not_of(" \t", at), text.size() - 1);
  const std::size_t last = next > 0 ? text.find_last_not_of(" \t", next - 1) : std::string::npos;
  if (last == std::string::npos || !(is_digit(last) || text[last] == '.')) return otherwise;
  if (text[next] == ',' && is_digit(next + 1)) return "a decimal point is a point: 0.5";
  if (std::isalpha(static_cast<unsigned char>(text[next])) != 0)
    return "numbers carry no unit; [units] names those of the case";
  return otherwise;
}

Sentence about_value(const std::string& text, std::size_t at) {
  const std::string token = up_to(text, at, " \t\r\n#,]}");
  std::string lower = token;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (lower == "true" || lower == "false") return {fmt::format("\"{}\" is not a value", token), "write " + lower};
  if (token.starts_with("\xE2\x80")) return {"curly quotes are not quotes", "use plain quotes: \"...\""};
  return {fmt::format("\"{}\" is not a value", token), "text and expressions stand in quotes: \"...\""};
}

Sentence about_string(const std::string& text, std::size_t at) {
  std::size_t i = at + 1;
  while (i < text.size() && text[i] != '\n' && text[i] != text[at]) i += text[i] == '\\' ? 2 : 1;
  if (i >= text.size() || text[i] == '\n')
    return {"the quote is never closed", fmt::format("add {} at its end", text[at])};
  return {"the text has an unknown escape after \\", "write \\\\ for a backslash, or put the text in single quotes"};
}

Sentence about_key(const std::string& text, std::size_t at) {
  const std::string rest = up_to(text, at, "\r\n");
  if (rest.starts_with('['))
    return {"the section header is not complete", "write [name], or [[name]] for a list of sections"};
  if (rest.find_first_not_of(" \t") == std::string::npos)
    return {"the line ends inside a table in braces", "a table { ... } stands on one line, without a comma at its end"};
  return {fmt::format("\"{}\" is not a key", up_to(text, at, " \t\r\n=")), key_letters};
}

std::string vector_or_components(const std::string& name) {
  if (name != "u" && name != "r") return "";
  return fmt::format("either {0} = [three values] or {0}.x, {0}.y, {0}.z one by one", name);
}

/// Explains a key with a value, followed by a dotted key that begins with the same name.
Sentence about_parts(const std::string& message) {
  const std::size_t begin = message.find("target (") + 8;
  const std::string name = geometry::shortened(message.substr(begin, message.find(')', begin) - begin));
  return {fmt::format("\"{0}\" has a value already, so there is no \"{0}.\" besides", name),
          vector_or_components(name)};
}

bool is_repeated(const std::string& path) {
  return std::ranges::any_of(sections(),
                             [&](const Section& s) { return s.path == path && s.header.starts_with("[["); });
}

/// Returns the line of the first header of a section; 0 if none is found.
std::size_t first_line(const std::string& text, const std::string& section) {
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::size_t at = line.find_first_not_of(" \t");
    if (at != std::string::npos && line.substr(at).starts_with("[" + section + "]")) return number;
  }
  return 0;
}

Sentence about_duplicate(const std::string& message, const std::string& text) {
  const std::string name = quoted_name(message);
  if (message.find(": table (") == std::string::npos && message.find("array of table") == std::string::npos)
    return {fmt::format("\"{}\" is given twice", name), vector_or_components(name)};
  const std::string what = fmt::format("section [{}] is given twice", name);
  const std::size_t first = first_line(text, name);
  if (is_repeated(name)) return {what, fmt::format("a repeated section is written [[{}]]", name)};
  return {what, fmt::format("put all its keys below one [{}]{}", name,
                            first == 0 ? "" : fmt::format(", the first is on line {}", first))};
}

Sentence translate(const std::string& message, const std::string& text, std::size_t at) {
  const auto says = [&](const char* words) { return message.find(words) != std::string::npos; };
  if (says("unknown value appeared") || says("not a boolean")) return about_value(text, at);
  if (says("not a valid string") || says("not a valid literal string")) return about_string(text, at);
  if (says("multiline string")) return {"the quotes are never closed", "add three quotes at the end of the text"};
  if (says("already exists") || says("collides") || says("cannot be defined")) return about_duplicate(message, text);
  if (says("neither table nor an array of tables")) return about_parts(message);
  if (says("missing value after")) return {"the value is missing after =", ""};
  if (says("missing key-value separator")) return {"expected = and a value after the key", "write key = value"};
  if (says("invalid character in key"))
    return {fmt::format("\"{}\" cannot stand in a key", up_to(text, text.find_first_not_of(" \t", at), " \t\r\n=")),
            key_letters};
  if (says("missing curly brace")) return {"expected } at the end of the table", "a table { ... } stands on one line"};
  if (says("empty key")) return {"the key is missing before =", ""};
  if (says("missing array separator"))
    return {"expected a comma or ] in the list", after_value(text, at, "text and expressions stand in quotes")};
  if (says("invalid format appeared in an array"))
    return {"this is not a value", "the list has a comma or a word without quotes too much"};
  if (says("trailing comma")) return {"a table in braces has no comma before its }", ""};
  if (says("missing table separator"))
    return {"expected a comma or } in the table", "text and expressions stand in quotes"};
  if (says("invalid line format"))
    return {fmt::format("unexpected \"{}\" after the value", up_to(text, at, "\r\n")),
            after_value(text, at, "text and expressions stand in quotes, and every key has its own line")};
  if (says("newline required after")) return {"unexpected text after the section header", ""};
  if (says("invalid key") || says("unknown line")) return about_key(text, at);
  if (says("date") || says("time")) return {"this is no value", "text and expressions stand in quotes"};
  if (says("float") || says("integer")) return {"this is not a number", "write numbers as 5, 0.5, 1e-3"};
  return {"this is not TOML", "see https://toml.io"};
}

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

/// Throws CaseErrors at the first place of the text that is nested deeper than deepest_nesting or begins too many
/// entries or sections. The reason: the parser recurses into lists, tables in braces and keys with dots until the stack
/// is full. It takes minutes for tables with thousands of entries.
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

/// Throws CaseErrors at a list or table of more than most_entries entries.
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

}  // namespace

toml::value parse_toml(const Source& source) {
  check_shape(source);
  std::istringstream stream(source.text());
  try {
    toml::value value = toml::parse(stream, source.file_name());
    check_counts(source, value);
    return value;
  } catch (const toml::syntax_error& error) {
    const auto& location = error.location();
    const std::string message = error.what();
    const std::size_t at = last_caret(source, message, source.offset(location.line(), location.column()));
    const Sentence sentence = translate(message, source.text(), at);
    throw CaseErrors({source.mistake({at, 1}, sentence.what, "", sentence.advice)});
  } catch (const CaseErrors&) {
    throw;
  } catch (const std::exception&) {
    throw CaseErrors({{.file = source.file_name(), .what = "the file cannot be read as TOML"}});
  }
}

}  // namespace plastron::config
