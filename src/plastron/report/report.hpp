// report.html: a computation as one page that opens in any browser without a network. It contains the case, the
// verdict, numbers, plots, and the deformed shell in a view that can be rotated (viewer/).
#pragma once
#include <plastron/io/csv_tables.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/io/results.hpp>
#include <plastron/report/report_scene.hpp>

#include <string>

namespace plastron::report {

using io::AtomicFiles, io::LineTable, io::Provenance;

inline constexpr std::string_view report_name = "report.html";

/// Returns the whole page, on the first rank. `scene` is the result of scene_json(), null if there is nothing to draw.
/// `lines` are the profiles to plot. Texts may contain anything.
std::string report_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines = {});

/// Adds directory/report.html; `is_drawn`: the solution exists and is finite (collective). Throws std::runtime_error.
void add_report(const computation::Result& result, const Provenance& provenance, bool is_drawn,
                const SceneFrames& frames, const std::vector<LineTable>& lines, const std::filesystem::path& directory,
                AtomicFiles& files);

// The sections of the page, each from the values in results.json.

/// Returns the status in a word and a sentence, and the number of the certificate's rows within their limits.
std::string verdict_html(const Json& results);
/// Returns estimated errors and required ones; empty if no errors were estimated.
std::string model_html(const Json& results);
std::string modes_html(const Json& results);
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

/// Returns a list of terms and descriptions as HTML; empty if a caller of the library gave no settings.
std::string case_html(const Json& settings);

}  // namespace plastron::report
