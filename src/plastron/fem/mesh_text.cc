#include <plastron/fem/mesh_text.hpp>

#include <plastron/fem/domain.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace plastron::fem {

namespace {

using geometry::parse;

/// Every process stores the coarse mesh. A file with a million cells has about 80 MB.
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
std::string content(const std::string& path) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.descriptor < 0)
    throw DomainError(errno == ENOENT || errno == ENOTDIR
                          ? fmt::format("{}: there is no such mesh file", path)
                          : fmt::format("{}: the mesh file cannot be opened: {}", path, std::strerror(errno)));
  struct stat status {};
  if (fstat(file.descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    throw DomainError(fmt::format("{}: it is no regular file; a mesh file is wanted", path));
  if (status.st_size > largest_file)
    throw DomainError(fmt::format("{}: it has {} MB; a mesh file has at most {} MB, for refinement is up to [mesh]",
                                  path, status.st_size >> 20, largest_file >> 20));
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t got = read(file.descriptor, text.data() + done, text.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw DomainError(fmt::format("{}: the mesh file cannot be read: {}", path, std::strerror(errno)));
    if (got == 0) break;  // the file became shorter meanwhile
    done += static_cast<std::size_t>(got);
  }
  text.resize(done);
  return text;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

MeshText::MeshText(std::string path) : path_(std::move(path)), text_(content(path_)) {}

bool MeshText::next_line() {
  while (next_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', next_), text_.size());
    line_ = trimmed(std::string_view(text_).substr(next_, end - next_));
    rest_ = line_;
    next_ = end + 1;
    ++number_;
    if (!line_.empty()) return true;
  }
  line_ = rest_ = {};
  return false;
}

void MeshText::expect_line(const char* what) {
  if (!next_line()) refuse(fmt::format("the file ends where {} should follow", what));
}

bool MeshText::has_word() const { return !rest_.empty(); }

std::string_view MeshText::word(const char* what) {
  if (rest_.empty()) refuse(fmt::format("the line \"{}\" ends where {} should follow", shown(line_), what));
  const auto end = static_cast<std::size_t>(std::ranges::find_if(rest_, is_blank) - rest_.begin());
  const std::string_view result = rest_.substr(0, end);
  rest_ = trimmed(rest_.substr(end));
  return result;
}

std::int64_t MeshText::integer(const char* what) {
  const std::string_view text = word(what);
  std::int64_t number = 0;
  if (!parse(text, number)) refuse(fmt::format("\"{}\" is no whole number; {} is wanted", shown(text), what));
  return number;
}

int MeshText::small_integer(const char* what) {
  const std::int64_t number = integer(what);
  if (number <= std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max())
    refuse(fmt::format("{} is too large a number for {}", number, what));
  return static_cast<int>(number);
}

double MeshText::real(const char* what) {
  const std::string_view text = word(what);
  double number = 0;
  if (!parse(text, number) || !std::isfinite(number))
    refuse(fmt::format("\"{}\" is no finite number; {} is wanted", shown(text), what));
  return number;
}

std::size_t MeshText::count(const char* what, std::size_t least) {
  const std::int64_t number = integer(what);
  const std::size_t left = text_.size() - std::min(next_, text_.size());
  if (number < 0 || static_cast<std::uint64_t>(number) > left / least + 1)
    refuse(fmt::format("{} is given as {}, but only {} bytes follow", what, number, left));
  return static_cast<std::size_t>(number);
}

void MeshText::expect_end_of_line() {
  if (has_word()) refuse(fmt::format("\"{}\" is more than the line should hold", shown(rest_)));
}

void MeshText::refuse(const std::string& what) const {
  throw DomainError(fmt::format("{}: line {}: {}", path_, number_, what));
}

}  // namespace plastron::fem
