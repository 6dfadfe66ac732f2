// Output of the program: text of one process only, results on standard output, errors on standard error. Text from
// files and arguments is made printable here. A print that fails (a closed pipe, a full disk) never ends a computation.
#pragma once
#include <plastron/config/printable.hpp>
#include <plastron/problem/unit_names.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

namespace plastron::app {

/// Whether this process prints for the job. Before MPI has started, the launcher's environment determines this; then
/// set_rank().
bool is_first_rank();
void set_rank(int rank);

/// Opens standard input, output and error if they are closed (no file of ours may take their number), and makes
/// writing to a closed pipe fail instead of ending the program. Call it first.
void secure_standard_streams();

/// Sets the names of the case's units. Text printed afterwards uses them.
void set_unit_names(problem::UnitNames units);
std::string with_unit_names(std::string_view text);

/// Prints our own text without change.
void print_raw(std::FILE* stream, std::string_view text);

/// Prints a text of one line or several; lines longer than 120 characters are broken at words.
void print_text(std::FILE* stream, std::string_view text);

template <class T>
decltype(auto) cleaned(const T& value) {
  if constexpr (std::is_convertible_v<const T&, std::string_view>)
    return config::printable(std::string_view(value));
  else
    return (value);
}

template <class... Args>
std::string formatted(fmt::string_view text, const Args&... args) {
  return fmt::vformat(text, fmt::make_format_args(args...));
}

template <class... Args>
void print(fmt::format_string<Args...> text, Args&&... args) {
  if (is_first_rank()) print_text(stdout, formatted(text, cleaned(args)...));
}
template <class... Args>
void print_error(fmt::format_string<Args...> text, Args&&... args) {
  if (is_first_rank()) print_text(stderr, formatted(text, cleaned(args)...));
}

/// Returns lines of at most `width` characters, if there are blanks. Continued lines are indented. Quoted lines of a
/// case file ("   12 | ...") are not broken.
std::string wrapped(std::string_view text, std::size_t width = 120);

// --json-log: events as one JSON object per line on standard error, for programs that monitor the computation. Every
// line has "event", and "time" in seconds since the start of the program. All other text for standard error becomes an
// event "error", so that each line is JSON.

using Details = nlohmann::ordered_json;

/// Starts the event log. Call it once, before anything is printed.
void log_events();
bool is_logging_events();

/// Logs an event on the first rank, if events are logged.
void log_event(std::string_view name, const Details& details = Details::object());
/// Logs an error on the rank where it occurs.
void log_error(std::string_view text);

// Text for a terminal of 100 columns: paragraphs, and rows of a label with its explanation.

inline constexpr std::size_t text_width = 100;

/// Number of characters, not of bytes.
std::size_t characters(std::string_view text);

/// Returns the text broken at blanks, with every line indented and a final line break.
std::string paragraph(std::string_view text, std::size_t indent = 0);
/// Returns the label with the text as a paragraph beside it, or below it if the label is wider than `label_width`.
std::string row(std::string_view label, std::size_t label_width, std::string_view text, std::size_t indent = 2);

}  // namespace plastron::app
