// Common output of all commands that compute.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/examination/examine.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::app {

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

}  // namespace plastron::app
