// --json-log: what happens, one JSON object a line on standard error, for programs that watch. Every line has "event", and "time" in
// seconds since the program began. All other text for standard error becomes an event "error", so that each line is JSON.
#pragma once
#include <nlohmann/json.hpp>

#include <string_view>

namespace plastron::app {

using Details = nlohmann::ordered_json;

/// From here on events are logged. To be called once, before anything is printed.
void log_events();
bool is_logging_events();

/// Nothing unless events are logged, and on the first rank only.
void log_event(std::string_view name, const Details& details = Details::object());
/// An error, on whichever rank it is found.
void log_error(std::string_view text);

}  // namespace plastron::app
