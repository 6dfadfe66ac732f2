#include "status_line.hpp"

#include "terminal.hpp"
#include "time_left.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace plastron::app {

namespace {

/// Returns the number of terminal columns that can be filled without a line break.
std::size_t columns() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col - 1U : 79U;
}

/// Returns the first characters of a line.
std::string cut(const std::string& line, std::size_t most) {
  std::string result;
  for (std::size_t at = 0, count = 0; at < line.size(); ++at) {
    if ((static_cast<unsigned char>(line[at]) & 0xC0) != 0x80 && ++count > most) break;
    result += line[at];
  }
  return result;
}

}  // namespace

StatusLine::StatusLine(bool quiet)
    : on_terminal_(!quiet && !is_logging_events() && is_first_rank() && isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() { clear(); }

double StatusLine::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

void StatusLine::show(const std::string& text, std::optional<double> end) {
  if (!on_terminal_) return;
  const std::lock_guard lock(mutex_);
  text_ = config::printable(text);
  end_ = end;
  shown_at_ = seconds();
  draw();
  if (!clock_.joinable()) clock_ = std::jthread([this](const std::stop_token& stop) { keep_up_to_date(stop); });
}

void StatusLine::clear() {
  if (!on_terminal_) return;
  const std::lock_guard lock(mutex_);
  text_.clear();
  draw();
}

/// Writes the whole line at once, and only if it has changed: a line that is first erased flickers.
void StatusLine::draw() {
  constexpr double long_time = 3;
  std::string line = text_;
  const double now = seconds();
  const std::string left = end_ ? left_text(*end_ - now) : "";
  if (!line.empty() && !left.empty())
    line += "; " + left;
  else if (!line.empty() && now - shown_at_ > long_time)
    line += fmt::format(" {:.0f} s", now - shown_at_);
  line = cut(line, columns());
  if (line == drawn_) return;
  const std::size_t length = characters(line), before = characters(drawn_);
  const std::string blanks(before > length ? before - length : 0, ' ');
  print_raw(stderr, "\r" + line + blanks + (line.empty() ? "\r" : ""));
  std::fflush(stderr);
  drawn_ = line;
}

void StatusLine::keep_up_to_date(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; }) && !stop.stop_requested())
    if (!text_.empty()) draw();
}

}  // namespace plastron::app
