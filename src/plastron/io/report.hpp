// report.html: a computation as one page that opens in any browser without a network. It contains the case, the
// verdict, numbers, plots, and the deformed shell in a view that can be rotated (viewer/).
#pragma once
#include <plastron/io/line_table.hpp>
#include <plastron/io/results.hpp>

namespace plastron::io {

inline constexpr std::string_view report_name = "report.html";

/// Returns the whole page, on the first rank. `scene` is the result of scene_json(), null if there is nothing to draw.
/// `lines` are the profiles to plot. Texts may contain anything.
std::string report_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines = {});

/// Adds directory/report.html; `is_drawn`: the solution exists and is finite (collective). Throws std::runtime_error.
void add_report(const computation::Result& result, const Provenance& provenance, bool is_drawn,
                const std::vector<LineTable>& lines, const std::filesystem::path& directory, AtomicFiles& files);

}  // namespace plastron::io
