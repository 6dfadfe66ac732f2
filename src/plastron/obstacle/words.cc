#include <plastron/geometry/file_words.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/words.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace plastron::obstacle {

namespace {

using geometry::parse;
using geometry::shown;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string file_content(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw ObstacleError(fmt::format("{}: there is no such file", path));
  if (!std::filesystem::is_regular_file(path, error))
    throw ObstacleError(fmt::format("{}: this is a directory, a pipe or a device, not a file", path));
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0));
  if (!stream) throw ObstacleError(fmt::format("{}: the file cannot be read", path));
  if (size > largest_obstacle_file)
    throw ObstacleError(
        fmt::format("{}: the file has {} MB, at most {} are read", path, size >> 20, largest_obstacle_file >> 20));
  std::string text(size, '\0');
  stream.seekg(0);
  stream.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

void Words::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

std::string_view Words::peek() const {
  std::size_t end = at_;
  while (end < text_.size() && !is_blank(text_[end])) ++end;
  return std::string_view(text_).substr(at_, end - at_);
}

std::string_view Words::next() {
  if (at_end()) refuse("the file ends too early");
  const std::string_view word = peek();
  last_end_ = at_ += word.size();
  skip_blanks();
  return word;
}

bool Words::take(std::string_view word) {
  if (at_end() || peek() != word) return false;
  next();
  return true;
}

std::string_view Words::rest_of_line() {
  const std::size_t begin = last_end_, end = std::min(text_.find('\n', begin), text_.size());
  last_end_ = at_ = end;
  skip_blanks();
  return std::string_view(text_).substr(begin, end - begin);
}

double Words::number(const char* what) {
  double value = 0;
  if (at_end()) refuse(fmt::format("the file ends where {} should stand", what));
  if (!parse(peek(), value)) refuse(fmt::format("found \"{}\" where {} should stand", shown(peek()), what));
  if (!(std::abs(value) <= largest_coordinate))
    refuse(fmt::format("{} is {}; finite numbers up to {:g} are allowed", what, shown(peek()), largest_coordinate));
  next();
  return value;
}

long Words::integer(const char* what) {
  long value = 0;
  if (at_end()) refuse(fmt::format("the file ends where {} should stand", what));
  if (!parse(peek(), value)) refuse(fmt::format("found \"{}\" where {} should stand", shown(peek()), what));
  next();
  return value;
}

void Words::refuse(const std::string& what) const {
  const auto line =
      1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
  throw ObstacleError(fmt::format("{}, line {}: {}", path_, line, what));
}

}  // namespace plastron::obstacle
