#include <plastron/domain/inp_lines.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::domain {

namespace {

constexpr double largest_coordinate = 1e100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string_view without_blanks(std::string_view text) {
  constexpr const char* blanks = " \t\r\v\f";
  const std::size_t from = text.find_first_not_of(blanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

std::string_view without_quotes(std::string_view text) {
  return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// Splits a line at commas that are not in quotes. A comma at the end adds no field.
void split_fields(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  bool is_quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] != ',' || is_quoted) continue;
    fields.push_back(without_blanks(line.substr(from, i - from)));
    from = i + 1;
  }
  if (from < line.size()) fields.push_back(without_blanks(line.substr(from)));
}

/// "Shell   Section" as "SHELL SECTION".
std::string keyword_name(std::string_view text) {
  std::string result;
  for (const char c : capitals(text))
    if (c != ' ' && c != '\t')
      result += c;
    else if (!result.ends_with(' '))
      result += ' ';
  return result;
}

}  // namespace

std::string capitals(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

std::optional<std::string_view> InpKeyword::value(std::string_view parameter) const {
  for (const auto& [name_of, value_of] : parameters)
    if (name_of == parameter) return value_of;
  return {};
}

InpLines::InpLines(const std::string& path) : text_(path, "input file", geometry::Lines::end_words) { advance(); }

void InpLines::advance() {
  if (std::exchange(is_ahead_, false)) return;
  do at_end_ = !text_.next_line();
  while (!at_end_ && text_.line().starts_with("**"));
}

InpKeyword InpLines::keyword() {
  if (!is_keyword())
    refuse(fmt::format("found \"{}\" where a keyword should stand, like *NODE or *ELEMENT",
                       geometry::shown(text_.line())));
  split_fields(text_.line(), fields_);
  InpKeyword result{.name = keyword_name(without_blanks(field(0).substr(1))), .line = line_number()};
  add_parameters(result, 1);
  while (ends_with_comma()) {
    advance();
    is_ahead_ = at_end_ || !is_letter(text_.line().front());
    if (is_ahead_) break;
    split_fields(text_.line(), fields_);
    add_parameters(result, 0);
  }
  return result;
}

void InpLines::add_parameters(InpKeyword& keyword, std::size_t first) const {
  for (std::size_t i = first; i < fields_.size(); ++i) {
    const std::string_view text = fields_[i];
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string_view value = text.substr(std::min(equals + 1, text.size()));
    keyword.parameters.emplace_back(capitals(without_blanks(text.substr(0, equals))),
                                    without_quotes(without_blanks(value)));
  }
}

bool InpLines::next_data() {
  advance();
  if (at_end_ || is_keyword()) return false;
  split_fields(text_.line(), fields_);
  return true;
}

void InpLines::skip_data() {
  while (next_data()) continue;
}

bool InpLines::is_label(std::size_t i) const {
  std::int64_t number = 0;
  return geometry::parse(field(i), number);
}

std::int64_t InpLines::label(std::size_t i, const char* what) const {
  std::int64_t number = 0;
  if (i >= field_count())
    refuse(fmt::format("the line \"{}\" ends where {} should stand", geometry::shown(text_.line()), what));
  if (!geometry::parse(field(i), number) || number < 1 || number > largest_label)
    refuse(fmt::format("found \"{}\" where {} should stand; whole numbers from 1 to {} are allowed",
                       geometry::shown(field(i)), what, largest_label));
  return number;
}

double InpLines::real(std::size_t i, const char* what) const {
  std::string text(field(i));
  if (text.empty()) return 0;
  std::ranges::replace_if(
      text, [](char c) { return c == 'D' || c == 'd'; }, 'e');
  double number = 0;
  if (!geometry::parse(std::string_view(text), number) || !(std::abs(number) <= largest_coordinate))
    refuse(fmt::format("found \"{}\" where {} should stand; finite numbers up to {:g} are allowed",
                       geometry::shown(field(i)), what, largest_coordinate));
  return number;
}

}  // namespace plastron::domain
