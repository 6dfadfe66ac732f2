// The sections of report.html as HTML, made from results.json's own values: verdict, warnings, key numbers, balance, contact, certificate,
// levels, history, files.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>

namespace plastron::io {

/// Status in a word and a sentence, and how many rows of the certificate keep their limits.
std::string verdict_html(const Json& results);
/// Estimated errors beside those that were asked for; empty where none were estimated.
std::string estimates_html(const Json& results);
std::string warnings_html(const Json& results);
std::string key_numbers_html(const Json& results);
/// Forces and moments on the shell: loads, supports, each obstacle, and their sum.
std::string balance_html(const Json& results);
/// Zones of each obstacle; what supports at points carry; probes.
std::string contact_html(const Json& results);
std::string probes_html(const Json& results);
std::string certificate_html(const Json& results);
std::string levels_html(const Json& results);
/// Empty without steps.
std::string history_html(const Json& results);
std::string files_html(const Json& results);

}  // namespace plastron::io
