#include <plastron/report/surface_page.hpp>

#include <plastron/io/results.hpp>
#include <plastron/report/embedded_page.hpp>
#include <plastron/report/report_html.hpp>
#include <plastron/report/surface_scene.hpp>
#include <plastron/topology/space_mesh.hpp>

#include <fmt/format.h>

#include <numbers>

namespace plastron::report {

namespace {

std::string view_html(const Json& scene) {
  if (embedded_page().script.empty())
    return "<p class=\"note\">This Plastron was built without the three-dimensional view (PLASTRON_VIEWER=OFF).</p>\n";
  if (scene.is_null())
    return fmt::format(
        "<p class=\"note\">The mesh has too many cells for the view of this page, which draws {} points.</p>\n",
        most_parts_points);
  return view_place_html();
}

std::string warnings_html(const std::vector<PageFinding>& findings) {
  std::string items;
  for (const PageFinding& finding : findings)
    if (finding.is_warning) items += fmt::format("<li>{}</li>\n", html_text(valid_utf8(finding.text)));
  return items.empty() ? "" : "<ul class=\"warnings\">\n" + items + "</ul>\n";
}

std::string notes_html(const std::vector<PageFinding>& findings) {
  std::string items;
  for (const PageFinding& finding : findings)
    if (!finding.is_warning) items += fmt::format("<li>{}</li>\n", html_text(valid_utf8(finding.text)));
  return items.empty() ? "" : "<ul>\n" + items + "</ul>\n";
}

std::string name_html(const std::string& name) { return html_text(valid_utf8(name)); }

std::string regions_html(const std::vector<RegionPart>& regions) {
  HtmlTable table({"<region", "cells", "turned", "area", "middle", "mean normal a3"});
  for (const RegionPart& region : regions)
    table.row({name_html(name_text(region)), fmt::format("{}", region.cells), fmt::format("{}", region.turned),
               html_number(region.area), html_text(topology::place_of(region.middle)), html_text(normal_text(region))});
  return "<p class=\"note\">In a case: <code>region = \"...\"</code>. Lengths are in the unit of the file.</p>\n" +
         table.text();
}

std::string curves_html(const std::vector<CurvePart>& curves) {
  if (curves.empty()) return "";
  HtmlTable table({"<curve", "<edges", "length", "largest angle [degrees]", "from", "to"});
  for (const CurvePart& curve : curves)
    table.row({name_html(curve.name), html_text(curve.edges.empty() ? "none: points" : kinds_text(curve)),
               html_number(curve.length), html_number(curve.largest_angle * 180 / std::numbers::pi, "", 1e3),
               curve.edges.empty() ? "" : html_text(topology::place_of(curve.low)),
               curve.edges.empty() ? "" : html_text(topology::place_of(curve.high))});
  return "<p class=\"note\">In a case: <code>boundary = \"...\"</code>. Names in brackets are no names of a case; "
         "\"fold 1\" and so on are given by the program.</p>\n" +
         table.text();
}

std::string doubtful_html(const topology::SurfaceTopology& topology) {
  const auto edges = doubtful_edges(topology);
  if (edges.empty()) return "";
  constexpr std::size_t most_rows = 50;
  HtmlTable table({"angle [degrees]", "<kind", "from", "to"});
  for (std::size_t i = 0; i < std::min(most_rows, edges.size()); ++i) {
    const topology::SurfaceEdge& edge = topology.edges[edges[i]];
    const auto end = [&](std::size_t k) {
      return html_text(topology::place_of(topology.mesh.nodes[static_cast<std::size_t>(edge.ends[k])]));
    };
    table.row({html_number(edge.angle * 180 / std::numbers::pi),
               edge.is_lone_fold ? "single fold: counts as smooth" : std::string(kind_word(edge.kind)), end(0),
               end(1)});
  }
  const std::string more =
      edges.size() > most_rows ? fmt::format("<p class=\"note\">and {} more</p>\n", edges.size() - most_rows) : "";
  return table.text() + more;
}

}  // namespace

std::string surface_page_html(const SurfacePage& page) {
  const bool has_script = !embedded_page().script.empty();
  const Json scene = has_script ? surface_scene_json(page.surface, page.regions, page.curves) : Json(nullptr);
  const std::string file = html_text(valid_utf8(std::filesystem::path(page.file).filename().string()));
  return page_html({.title = "Parts of " + file,
                    .kind = "parts",
                    .version = std::string(io::version),
                    .content = warnings_html(page.findings) + view_html(scene) +
                               html_section("regions", "Regions", regions_html(page.regions)) +
                               html_section("curves", "Curves and folds", curves_html(page.curves)) +
                               html_section("doubtful", "Doubtful edges", doubtful_html(page.surface.topology)) +
                               html_section("notes", "Notes", notes_html(page.findings)),
                    .footer = "This page needs no network.",
                    .scene = script_json(scene)});
}

std::string page_name_mistake(const std::filesystem::path& path, const std::filesystem::path& mesh) {
  if (path.extension() != ".html" && path.extension() != ".htm")
    return fmt::format("the page \"{}\" must end in .html", path.string());
  std::error_code ignored;
  if (std::filesystem::equivalent(path, mesh, ignored))
    return fmt::format("the page \"{}\" would replace the mesh; give it another name", path.string());
  return "";
}

}  // namespace plastron::report
