#include <plastron/config/mistakes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace plastron::config {

namespace {

// One character of the terminal for each code point; control characters would disturb it.
std::string printable(const std::string& text) {
  std::string clean = text;
  for (char& c : clean)
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t') c = '?';
  return clean;
}

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

// Blanks up to the mistake, keeping tabs so that the caret stands below its character whatever a tab is worth.
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
  std::string text;
  if (mistake.line == 0) {
    text = fmt::format("{}: error: {}\n", mistake.file, mistake.what);
  } else {
    text = fmt::format("{}:{}:{}: error: {}\n", mistake.file, mistake.line, mistake.column, mistake.what);
    text += fmt::format("{:5} | {}\n", mistake.line, printable(mistake.source_line));
    text += fmt::format("      | {}\n", caret_line(mistake.source_line, mistake.column, mistake.length));
  }
  if (!mistake.allowed.empty()) text += fmt::format("   allowed: {}\n", mistake.allowed);
  if (!mistake.advice.empty()) text += fmt::format("   {}\n", mistake.advice);
  return text;
}

CaseErrors::CaseErrors(std::vector<Mistake> mistakes)
    : std::runtime_error(format_all(in_file_order(mistakes))), mistakes_(in_file_order(std::move(mistakes))) {}

}  // namespace plastron::config
