// Printing: one process only, results on standard output, errors on standard error. Text from files
// and arguments is made printable here. A print that fails (a closed pipe, a full disk) never ends a computation.
#pragma once
#include <plastron/config/printable.hpp>
#include <plastron/problem/unit_names.hpp>

#include <fmt/format.h>

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

}  // namespace plastron::app
