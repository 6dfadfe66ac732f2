// Describes the case for report.html, from the settings in results.json.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>

namespace plastron::io {

/// Returns a list of terms and descriptions as HTML; empty if a caller of the library gave no settings.
std::string case_html(const Json& settings);

}  // namespace plastron::io
