#include "terminal.hpp"

#include <plastron/algebra/session.hpp>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace plastron::app {

namespace {

std::optional<int> known_rank;
problem::UnitNames unit_names;

/// The rank that the launcher of a parallel job gave this process; 0 if there is none.
int rank_in_environment() {
  const char* rank = algebra::rank_of_launcher();
  return rank ? std::atoi(rank) : 0;
}

bool is_quotation(std::string_view line) {
  constexpr std::size_t bar = 6;
  return line.size() > bar && line[bar] == '|' && line.find_first_not_of(" 0123456789") == bar;
}

/// Returns the best place to break a long line: the last blank with at most `width` characters before it.
std::size_t break_of(std::string_view line, std::size_t indent, std::size_t width) {
  std::size_t found = std::string_view::npos;
  for (std::size_t blank = line.find(' ', indent); blank != std::string_view::npos; blank = line.find(' ', blank + 1)) {
    if (found != std::string_view::npos && characters(line.substr(0, blank)) > width) break;
    found = blank;
  }
  return found;
}

std::string wrapped_line(std::string_view line, std::size_t width) {
  constexpr std::string_view indent = "    ";
  std::string text, rest(line);
  std::size_t first_word = rest.find_first_not_of(' ');
  while (characters(rest) > width) {
    const std::size_t at = break_of(rest, first_word, width);
    if (at == std::string::npos || rest.find_first_not_of(' ', at) == std::string::npos) break;
    text += rest.substr(0, at) + "\n";
    rest = std::string(indent) + rest.substr(rest.find_first_not_of(' ', at));
    first_word = indent.size();
  }
  return text + rest;
}

}  // namespace

bool is_first_rank() {
  if (!known_rank) known_rank = rank_in_environment();
  return *known_rank == 0;
}

void set_rank(int rank) { known_rank = rank; }

void set_unit_names(problem::UnitNames units) { unit_names = std::move(units); }
std::string with_unit_names(std::string_view text) { return unit_names.renamed(text); }

void secure_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      const int place = open("/dev/null", O_RDWR);
      if (place != -1 && place != stream) {
        dup2(place, stream);
        close(place);
      }
    }
  signal(SIGPIPE, SIG_IGN);
}

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    result += is_quotation(line) ? std::string(line) : wrapped_line(line, width);
    if (end == std::string_view::npos) break;
    result += '\n';
    text.remove_prefix(end + 1);
  }
  return result;
}

void print_raw(std::FILE* stream, std::string_view text) {
  // Errors are ignored, because the reader may have closed the stream.
  std::fwrite(text.data(), 1, text.size(), stream);
}

void print_text(std::FILE* stream, std::string_view given) {
  const std::string named = with_unit_names(given);
  std::string_view text = named;
  if (stream == stderr && is_logging_events()) {
    text = text.substr(0, text.find_last_not_of('\n') + 1);
    if (!text.empty()) log_error(text);
    return;
  }
  print_raw(stream, wrapped(config::printable(text, config::LineBreaks::keep)));
}

std::size_t characters(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text)
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) ++count;
  return count;
}

namespace {

/// Returns words from column `column` on; further lines begin at `indent`.
std::string filled(std::string_view text, std::size_t column, std::size_t indent) {
  std::istringstream words{std::string(text)};
  std::string result, word;
  bool is_first = true;
  while (words >> word) {
    const std::size_t length = characters(word);
    if (!is_first && column + 1 + length > text_width) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
      is_first = true;
    }
    if (!is_first) result += ' ';
    result += word;
    column += length + (is_first ? 0 : 1);
    is_first = false;
  }
  return result;
}

}  // namespace

std::string paragraph(std::string_view text, std::size_t indent) {
  return std::string(indent, ' ') + filled(text, indent, indent) + "\n";
}

std::string row(std::string_view label, std::size_t label_width, std::string_view text, std::size_t indent) {
  const std::size_t column = indent + label_width + 1, length = characters(label);
  std::string line = std::string(indent, ' ') + std::string(label);
  if (text.empty()) return line + "\n";
  line += length > label_width ? "\n" + std::string(column, ' ') : std::string(column - indent - length, ' ');
  return line + filled(text, column, column) + "\n";
}

namespace {

using Clock = std::chrono::steady_clock;

std::optional<Clock::time_point> logging_since;

double seconds() {
  const double exact = std::chrono::duration<double>(Clock::now() - *logging_since).count();
  return std::round(1e3 * exact) / 1e3;
}

void write(std::string_view name, const Details& details) {
  Details event{{"event", name}, {"time", seconds()}};
  event.update(details);
  print_raw(stderr, event.dump(-1, ' ', false, Details::error_handler_t::replace) + "\n");
  std::fflush(stderr);
}

}  // namespace

void log_events() {
  if (!logging_since) logging_since = Clock::now();
}

bool is_logging_events() { return logging_since.has_value(); }

void log_event(std::string_view name, const Details& details) {
  if (is_logging_events() && is_first_rank()) write(name, details);
}

void log_error(std::string_view text) {
  if (is_logging_events()) write("error", {{"text", text}});
}

}  // namespace plastron::app
