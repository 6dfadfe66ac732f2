#include "event_log.hpp"

#include "terminal.hpp"

#include <chrono>
#include <cmath>
#include <optional>

namespace plastron::app {

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
