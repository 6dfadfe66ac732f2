// --json-log: events as one JSON object per line on standard error, for programs that monitor the computation. Every
// line has "event", and "time" in seconds since the start of the program. All other text for standard error becomes an
// event "error", so that each line is JSON.
#pragma once
#include <nlohmann/json.hpp>

#include <string_view>

namespace plastron::app {

using Details = nlohmann::ordered_json;

/// Starts the event log. Call it once, before anything is printed.
void log_events();
bool is_logging_events();

/// Logs an event on the first rank, if events are logged.
void log_event(std::string_view name, const Details& details = Details::object());
/// Logs an error on the rank where it occurs.
void log_error(std::string_view text);

}  // namespace plastron::app
