#include <plastron/report/report.hpp>

#include <plastron/io/bytes.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/result_plots.hpp>
#include <plastron/report/embedded_page.hpp>
#include <plastron/report/report_html.hpp>
#include <plastron/report/report_scene.hpp>

#include <fmt/format.h>

namespace plastron::report {

namespace {

/// Returns a text on the drawn instant, for a computation with steps.
std::string instant_html(const Json& results) {
  const Json& history = at_path(results, "history");
  if (history.empty()) return "";
  return fmt::format("<p class=\"note\">At the end of step {}, time {}. All instants are in solution.pvd.</p>\n",
                     html_text(plain_words(history.back()["step"])), html_number(history.back()["time"]));
}

std::string view_html(const Json& results, const Json& scene, bool has_script) {
  if (!has_script)
    return "<p class=\"note\">This Plastron was built without the three-dimensional view (PLASTRON_VIEWER=OFF). Open "
           "solution.pvd in ParaView.</p>\n";
  if (scene.is_null())
    return "<p class=\"note\">There is no surface to draw: nothing was solved, the solution is not finite, or the "
           "coarsest "
           "mesh has too many points for this page. In the last case open solution.pvd in ParaView.</p>\n";
  return instant_html(results) + view_place_html();
}

/// Returns the plots as pictures with separate styles and names.
std::string plots_html(const std::vector<io::NamedPlot>& plots) {
  std::string html;
  for (const auto& [name, plot] : plots)
    html += fmt::format("<img class=\"plot\" alt=\"{}: {} over {}\" src=\"data:image/svg+xml;base64,{}\">\n",
                        html_text(valid_utf8(plot.title)), html_text(valid_utf8(plot.y.label)),
                        html_text(valid_utf8(plot.x.label)),
                        io::base64(valid_utf8(io::svg_text(plot, io::PlotLayout::narrow))));
  return html.empty() ? "" : "<div class=\"plots\">\n" + html + "</div>\n";
}

std::string profiles_html(const std::vector<LineTable>& lines) {
  std::string html;
  for (const LineTable& line : lines) html += plots_html(io::line_plots(line.name, line.csv));
  return html;
}

std::string content_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines, bool has_script) {
  return verdict_html(results) + html_section("warnings", "Warnings", warnings_html(results)) +
         key_numbers_html(results) + html_section("estimates", "Estimated errors", estimates_html(results)) +
         html_section("model", "Linear model and finite rotations", model_html(results)) +
         html_section("modes", "Buckling and vibration", modes_html(results)) +
         html_section("shell", "Deformed shell", view_html(results, scene, has_script)) +
         html_section("case", "The case", case_html(at_path(results, "settings"))) +
         html_section("balance", "Forces and moments", balance_html(results)) +
         html_section("contact", "Contact zones", contact_html(results)) +
         html_section("probes", "Probes", probes_html(results)) +
         html_section("lines", "Profiles along lines", profiles_html(lines)) +
         html_section("plots", "Plots", plots_html(io::result_plots(results))) +
         html_section("certificate", "Certificate", certificate_html(results)) +
         html_section("levels", "Meshes", levels_html(results)) +
         html_section("history", "Steps", history_html(results)) + html_section("files", "Files", files_html(results));
}

}  // namespace

std::string report_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines) {
  const bool has_script = !embedded_page().script.empty();
  const std::string given = plain_words(at_path(results, "title"));
  return page_html({.title = html_text(given.empty() ? "A shell computed by Plastron" : given),
                    .kind = "report",
                    .version = html_text(plain_words(at_path(results, "versions/plastron"))),
                    .content = io::unit_names(results).renamed(content_html(results, scene, lines, has_script)),
                    .footer = "This page needs no network; all numbers are those of results.json, which it holds.",
                    .results = script_json(results),
                    .scene = script_json(has_script ? scene : Json(nullptr))});
}

void add_report(const computation::Result& result, const Provenance& provenance, bool is_drawn,
                const SceneFrames& frames, const std::vector<LineTable>& lines, const std::filesystem::path& directory,
                AtomicFiles& files) {
  const bool has_view = is_drawn && !embedded_page().script.empty();
  const Json scene = has_view ? scene_json(*result.solution, result.summary, provenance.units, frames) : Json(nullptr);
  files.add_text(directory / report_name, [&] {
    const std::string text = io::results_json(result, provenance).dump(-1, ' ', false, Json::error_handler_t::replace);
    return report_html(Json::parse(text), scene, lines);
  });
}

}  // namespace plastron::report
