// The sections of report.html as HTML, made from the values in results.json: verdict, warnings, key numbers, balance,
// contact, certificate, levels, history, files.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>

namespace plastron::io {

/// Returns the status in a word and a sentence, and the number of the certificate's rows within their limits.
std::string verdict_html(const Json& results);
/// Returns estimated errors and required ones; empty if no errors were estimated.
std::string estimates_html(const Json& results);
std::string warnings_html(const Json& results);
std::string key_numbers_html(const Json& results);
/// Returns forces and moments on the shell: loads, supports, each obstacle, and their sum.
std::string balance_html(const Json& results);
/// Returns zones of each obstacle, forces of supports at points, and probes.
std::string contact_html(const Json& results);
std::string probes_html(const Json& results);
std::string certificate_html(const Json& results);
std::string levels_html(const Json& results);
/// Returns the history; empty without steps.
std::string history_html(const Json& results);
std::string files_html(const Json& results);

}  // namespace plastron::io
