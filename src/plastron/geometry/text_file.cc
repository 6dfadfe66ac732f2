#include <plastron/geometry/text_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace plastron::geometry {

namespace {

/// Every process stores a coarse mesh. A mesh file with a million cells has about 80 MB.
constexpr std::int64_t largest_file = 256 << 20;

struct OpenFile {
  int descriptor;
  explicit OpenFile(int d) : descriptor(d) {}
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
};

/// Reads the file. It examines the open file, not its name: the file cannot be replaced in between, and a pipe does
/// not block.
std::string content(const std::string& path, const std::string& kind) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.descriptor < 0)
    throw FileError(errno == ENOENT || errno == ENOTDIR
                        ? fmt::format("{}: there is no such {}", path, kind)
                        : fmt::format("{}: the {} cannot be opened: {}", path, kind, std::strerror(errno)));
  struct stat status {};
  if (fstat(file.descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    throw FileError(fmt::format("{}: this is no regular file but a directory, a pipe or a device", path));
  if (status.st_size > largest_file)
    throw FileError(fmt::format("{}: the {} has {} MB, at most {} MB are read", path, kind, status.st_size >> 20,
                                largest_file >> 20));
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = read(file.descriptor, text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(fmt::format("{}: the {} cannot be read: {}", path, kind, std::strerror(errno)));
    if (got == 0) break;  // the file became shorter meanwhile
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result(text.substr(0, longest));
  std::ranges::replace_if(
      result, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > longest ? result + "..." : result;
}

TextFile::TextFile(std::string path, const std::string& kind, Lines lines)
    : path_(std::move(path)), text_(content(path_, kind)), lines_(lines) {}

TextFile::TextFile(std::string path, std::string text, Lines lines, std::in_place_t)
    : path_(std::move(path)), text_(std::move(text)), lines_(lines) {}

bool TextFile::next_line() {
  while (next_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    line_ = rest_ = trimmed(std::string_view(text_).substr(next_, end - next_));
    next_ = end + 1;
    ++number_;
    if (!line_.empty()) return true;
  }
  line_ = rest_ = {};
  return false;
}

void TextFile::expect_line(const char* what) {
  if (!next_line()) refuse(fmt::format("the file ends where {} should stand", what));
}

std::string_view TextFile::peek() const {
  return rest_.substr(0, static_cast<std::size_t>(std::ranges::find_if(rest_, is_blank) - rest_.begin()));
}

std::string_view TextFile::word(const char* what) {
  if (rest_.empty() && lines_ == Lines::run_on) expect_line(what);
  if (rest_.empty()) refuse(fmt::format("the line \"{}\" ends where {} should stand", shown(line_), what));
  const std::string_view result = peek();
  rest_ = trimmed(rest_.substr(result.size()));
  return result;
}

bool TextFile::take(std::string_view word) {
  if (at_end() || peek() != word) return false;
  rest_ = trimmed(rest_.substr(word.size()));
  return true;
}

std::int64_t TextFile::integer(const char* what) {
  const std::string_view text = word(what);
  std::int64_t number = 0;
  if (!parse(text, number)) refuse(fmt::format("\"{}\" is no whole number; {} is wanted", shown(text), what));
  return number;
}

int TextFile::small_integer(const char* what) {
  const std::int64_t number = integer(what);
  if (number <= std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max())
    refuse(fmt::format("{} is too large a number for {}", number, what));
  return static_cast<int>(number);
}

double TextFile::real(const char* what, double largest) {
  const std::string_view text = word(what);
  double number = 0;
  if (!parse(text, number) || !(std::abs(number) <= largest))
    refuse(fmt::format("found \"{}\" where {} should stand; finite numbers up to {:g} are allowed", shown(text), what,
                       largest));
  return number;
}

std::size_t TextFile::count(const char* what, std::size_t least) {
  const std::int64_t number = integer(what);
  const std::size_t left = text_.size() - std::min(next_, text_.size());
  if (number < 0 || static_cast<std::uint64_t>(number) > left / least + 1)
    refuse(fmt::format("{} is given as {}, but only {} bytes follow", what, number, left));
  return static_cast<std::size_t>(number);
}

void TextFile::expect_end_of_line() {
  if (has_word()) refuse(fmt::format("\"{}\" is more than the line should hold", shown(rest_)));
}

void TextFile::refuse(const std::string& what) const {
  throw FileError(fmt::format("{}: line {}: {}", path_, number_, what));
}

}  // namespace plastron::geometry
