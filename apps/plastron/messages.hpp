// What all commands that compute tell in the same way.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/examination/examine.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::app {

/// A title as it is shown: long ones are cut.
std::string shortened_title(const std::string& title);

/// The findings of an examination, notes only if wanted.
void print_findings(const std::vector<examination::Finding>& findings, const std::string& case_file, bool with_notes);

/// A warning of the computation, on standard error.
void print_warning(const std::string& case_file, std::string_view text);

/// The event that tells how a computation has ended.
void log_status(contact::Status status, std::string_view text);

/// The event of a mesh that is solved.
void log_level(int level, const computation::Level& record);

}  // namespace plastron::app
