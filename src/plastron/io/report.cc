#include <plastron/io/report.hpp>

#include <plastron/io/bytes.hpp>
#include <plastron/io/plot.hpp>
#include <plastron/io/report_html.hpp>
#include <plastron/io/report_scene.hpp>
#include <plastron/io/result_plots.hpp>

#include <fmt/format.h>

// Defined in embedded_page.S, which includes the files without change.
extern "C" {
extern const char plastron_page_begin[], plastron_page_end[];
extern const char plastron_style_begin[], plastron_style_end[];
extern const char plastron_script_begin[], plastron_script_end[];
extern const char plastron_script_source_begin[], plastron_script_source_end[];
}

namespace plastron::io {

namespace {

/// The parts of the page that do not depend on the computation (cmake/PlastronViewer.cmake). Page and style are copied
/// from viewer/src; the script is bundled from viewer/src with vtk.js.
struct EmbeddedPage {
  std::string_view page;    ///< HTML with places {{...}} that report_html() fills
  std::string_view style;   ///< CSS
  std::string_view script;  ///< the three-dimensional view; empty where Plastron was built with PLASTRON_VIEWER=OFF
  std::string_view script_source;  ///< hash of the script, its name in the page's policy; 'none' without script
};

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

EmbeddedPage embedded_page() {
  return {.page = between(plastron_page_begin, plastron_page_end),
          .style = between(plastron_style_begin, plastron_style_end),
          .script = between(plastron_script_begin, plastron_script_end),
          .script_source = between(plastron_script_source_begin, plastron_script_source_end)};
}

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
  return instant_html(results) +
         "<div id=\"view\"><noscript><p class=\"note\">The three-dimensional view needs JavaScript. The other parts of "
         "this page do not.</p></noscript></div>\n";
}

/// Returns the plots as pictures with separate styles and names.
std::string plots_html(const std::vector<NamedPlot>& plots) {
  std::string html;
  for (const auto& [name, plot] : plots)
    html += fmt::format("<img class=\"plot\" alt=\"{}: {} over {}\" src=\"data:image/svg+xml;base64,{}\">\n",
                        html_text(valid_utf8(plot.title)), html_text(valid_utf8(plot.y.label)),
                        html_text(valid_utf8(plot.x.label)), base64(valid_utf8(svg_text(plot, PlotLayout::narrow))));
  return html.empty() ? "" : "<div class=\"plots\">\n" + html + "</div>\n";
}

std::string profiles_html(const std::vector<LineTable>& lines) {
  std::string html;
  for (const LineTable& line : lines) html += plots_html(line_plots(line.name, line.csv));
  return html;
}

std::string content_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines, bool has_script) {
  return verdict_html(results) + html_section("warnings", "Warnings", warnings_html(results)) +
         key_numbers_html(results) + html_section("estimates", "Estimated errors", estimates_html(results)) +
         html_section("shell", "Deformed shell", view_html(results, scene, has_script)) +
         html_section("case", "The case", case_html(at_path(results, "settings"))) +
         html_section("balance", "Forces and moments", balance_html(results)) +
         html_section("contact", "Contact zones", contact_html(results)) +
         html_section("probes", "Probes", probes_html(results)) +
         html_section("lines", "Profiles along lines", profiles_html(lines)) +
         html_section("plots", "Plots", plots_html(result_plots(results))) +
         html_section("certificate", "Certificate", certificate_html(results)) +
         html_section("levels", "Meshes", levels_html(results)) +
         html_section("history", "Steps", history_html(results)) + html_section("files", "Files", files_html(results));
}

}  // namespace

std::string report_html(const Json& results, const Json& scene, const std::vector<LineTable>& lines) {
  const EmbeddedPage parts = embedded_page();
  const std::string given = plain_words(at_path(results, "title"));
  const std::string title = html_text(given.empty() ? "A shell computed by Plastron" : given);
  return filled(parts.page,
                {{"title", title},
                 {"style", std::string(parts.style)},
                 {"version", html_text(plain_words(at_path(results, "versions/plastron")))},
                 {"content", unit_names(results).renamed(content_html(results, scene, lines, !parts.script.empty()))},
                 {"results", script_json(results)},
                 {"scene", script_json(parts.script.empty() ? Json(nullptr) : scene)},
                 {"script_source", std::string(parts.script_source)},
                 {"script", std::string(parts.script)}});
}

void add_report(const computation::Result& result, const Provenance& provenance, bool is_drawn,
                const std::vector<LineTable>& lines, const std::filesystem::path& directory, AtomicFiles& files) {
  const bool has_view = is_drawn && !embedded_page().script.empty();
  const Json scene = has_view ? scene_json(*result.solution, result.summary, provenance.units) : Json(nullptr);
  files.add_text(directory / report_name, [&] {
    const std::string text = results_json(result, provenance).dump(-1, ' ', false, Json::error_handler_t::replace);
    return report_html(Json::parse(text), scene, lines);
  });
}

}  // namespace plastron::io
