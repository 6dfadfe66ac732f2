// The parts that both computing programs share: reading of cases, messages, the output directory, interruptions.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/config/case.hpp>
#include <plastron/examination/examine.hpp>

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::app {

/// Returns the case with `settings` in place of some of its keys (workflow::read_together()). Text printed afterwards uses
/// the names of its units.
config::Case read_case(const std::filesystem::path& path, std::span<const std::string> settings);

/// Prints a line with the title of a case, shortened, or `without` if it has no title. Units in a title are not renamed.
void print_title(const std::string& title, const std::string& without);

/// Prints the findings of an examination, with notes if requested.
void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes);

/// Prints a warning of the computation on standard error.
void print_warning(const std::string& case_file, std::string_view text);

/// Logs the event of a computation's end.
void log_status(contact::Status status, std::string_view text);

/// Logs the event of a solved mesh.
void log_level(int level, const computation::Level& record);

/// From now on the first Ctrl-C or SIGTERM requests the computation to stop and to write the finished results. The second
/// one ends it immediately.
void listen_for_interruptions();
bool is_interrupted();

}  // namespace plastron::app
