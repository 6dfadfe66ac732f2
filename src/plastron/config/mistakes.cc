#include <plastron/config/mistakes.hpp>
#include <plastron/config/printable.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace plastron::config {

namespace {

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// Returns blanks up to the mistake, and keeps tabs, so that the caret is below its character for any width of tabs.
std::string caret_line(const std::string& line, int column, int length) {
  std::string carets;
  int character = 0;
  for (const char c : line)
    if (starts_code_point(c)) {
      ++character;
      if (character < column) carets += c == '\t' ? '\t' : ' ';
      if (character > column && character < column + length) carets += '~';
      if (character == column) carets += '^';
    }
  if (character < column) carets += '^';
  return carets;
}

/// The part of a long line around the mistake, and the position of the mistake in it.
struct Excerpt {
  std::string line;
  int column;
};

Excerpt excerpt(const std::string& line, int column) {
  constexpr int most = 100, before = 50;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (starts_code_point(line[i])) begins.push_back(i);
  const int count = static_cast<int>(begins.size());
  if (count <= most) return {line, column};
  const int first = std::clamp(column - 1 - before, 0, count - most), end = first + most;
  const auto at = [&](int character) {
    return character < count ? begins[static_cast<std::size_t>(character)] : line.size();
  };
  const std::string dots = "...";
  return {(first > 0 ? dots : "") + line.substr(at(first), at(end) - at(first)) + (end < count ? dots : ""),
          column - first + (first > 0 ? static_cast<int>(dots.size()) : 0)};
}

std::string format_all(const std::vector<Mistake>& mistakes) {
  std::string text;
  for (const Mistake& mistake : mistakes) text += format(mistake);
  return text;
}

std::vector<Mistake> in_file_order(std::vector<Mistake> mistakes) {
  std::ranges::stable_sort(mistakes, [](const Mistake& a, const Mistake& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  return mistakes;
}

}  // namespace

std::string format(const Mistake& mistake) {
  const std::string file = printable(mistake.file), what = printable(mistake.what);
  std::string text;
  if (mistake.line == 0) {
    text = fmt::format("{}: error: {}\n", file, what);
  } else {
    const Excerpt quoted = excerpt(mistake.source_line, mistake.column);
    text = fmt::format("{}:{}:{}: error: {}\n", file, mistake.line, mistake.column, what);
    text += fmt::format("{:5} | {}\n", mistake.line, printable(quoted.line));
    text += fmt::format("      | {}\n", caret_line(quoted.line, quoted.column, mistake.length));
  }
  if (!mistake.allowed.empty()) text += fmt::format("   allowed: {}\n", printable(mistake.allowed));
  if (!mistake.advice.empty()) text += fmt::format("   {}\n", printable(mistake.advice));
  return text;
}

CaseErrors::CaseErrors(std::vector<Mistake> mistakes)
    : std::runtime_error(format_all(in_file_order(mistakes))), mistakes_(in_file_order(std::move(mistakes))) {}

}  // namespace plastron::config
