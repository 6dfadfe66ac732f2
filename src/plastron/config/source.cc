#include <plastron/config/printable.hpp>
#include <plastron/config/source.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace plastron::config {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool in_identifier(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool in_bare_key(char c) { return in_identifier(c) || c == '-'; }

// Returns the number of source bytes of one character of a string.
std::size_t source_length(const std::string& text, std::size_t at, bool escapes) {
  if (!escapes || text[at] != '\\' || at + 1 >= text.size()) return 1;
  return text[at + 1] == 'u' ? 6 : text[at + 1] == 'U' ? 10 : 2;
}

int characters(const std::string& text, std::size_t begin, std::size_t end) {
  int count = 0;
  for (std::size_t i = begin; i < std::min(end, text.size()); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) ++count;
  return count;
}

}  // namespace

Source::Source(std::string text, std::string file_name) : text_(std::move(text)), file_name_(std::move(file_name)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  line_begins_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_begins_.push_back(i + 1);
  if (text_.find_first_not_of(" \t\r\n") == std::string::npos)
    throw CaseErrors({{.file = file_name_, .what = "the file is empty"}});
  for (std::size_t i = 0, length = 0; i < text_.size(); i += length) {
    length = code_point_length(text_, i);
    if (length == 0)
      throw CaseErrors(
          {mistake({i, 1}, fmt::format("byte 0x{:02X} is not UTF-8 text", static_cast<unsigned char>(text_[i])), "",
                   "save the file in the encoding UTF-8")});
  }
}

std::size_t Source::offset(std::size_t line, std::size_t column) const {
  if (line < 1 || line > line_begins_.size()) return text_.size();
  return std::min(line_begins_[line - 1] + column - 1, text_.size());
}

Place Source::value(const toml::value& value) const {
  const auto location = value.location();
  return {offset(location.line(), location.column()), std::max<std::size_t>(location.region(), 1)};
}

Place Source::key(const std::string& name, const toml::value& value) const {
  const Place at = this->value(value);
  std::size_t end = at.offset;
  const auto skip_blanks = [&] {
    while (end > 0 && is_blank(text_[end - 1])) --end;
  };
  skip_blanks();
  if (end == 0 || text_[end - 1] != '=') {  // a header or a dotted key: toml11 gives it as the table's place
    const std::size_t found = text_.substr(at.offset, at.length).find(name);
    return found == std::string::npos ? at : Place{at.offset + found, name.size()};
  }
  --end;
  skip_blanks();
  std::size_t begin = end;
  if (end > 1 && (text_[end - 1] == '"' || text_[end - 1] == '\'')) {
    const std::size_t quote = text_.rfind(text_[end - 1], end - 2);
    begin = quote == std::string::npos ? end - 1 : quote;
  } else {
    while (begin > 0 && in_bare_key(text_[begin - 1])) --begin;
  }
  return {begin, std::max<std::size_t>(end - begin, 1)};
}

Place Source::inside(const toml::value& string, std::size_t position) const {
  std::size_t at = value(string).offset;
  const char quote = text_[at];
  if (text_.compare(at, 3, std::string(3, quote)) == 0) {
    at += 3;
    if (text_[at] == '\r') ++at;
    if (text_[at] == '\n') ++at;
  } else {
    ++at;
  }
  for (std::size_t i = 0; i < position && at < text_.size(); ++i) at += source_length(text_, at, quote == '"');
  std::size_t length = 0;
  while (at + length < text_.size() && in_identifier(text_[at + length])) ++length;
  return {at, std::max<std::size_t>(length, 1)};
}

Mistake Source::mistake(Place place, std::string what, std::string allowed, std::string advice) const {
  const auto after = std::ranges::upper_bound(line_begins_, place.offset);
  const std::size_t begin = *std::prev(after);
  const std::size_t end = after == line_begins_.end() ? text_.size() : *after - 1;
  std::string line = text_.substr(begin, end - begin);
  if (line.ends_with('\r')) line.pop_back();
  return {.file = file_name_,
          .line = static_cast<int>(after - line_begins_.begin()),
          .column = characters(text_, begin, place.offset) + 1,
          .length = characters(text_, place.offset, place.offset + place.length),
          .source_line = std::move(line),
          .what = std::move(what),
          .allowed = std::move(allowed),
          .advice = std::move(advice)};
}

}  // namespace plastron::config
