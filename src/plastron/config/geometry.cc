// Reads [geometry]: the domain and its charts.
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>
#include <plastron/geometry/triangle_mesh.hpp>

#include <algorithm>
#include <filesystem>

namespace plastron::config {

namespace {

using domain::SpaceReading;
using Formulas = std::array<std::string, 3>;

std::optional<std::string> read_formula(Reading& reading, const Item& item) {
  const auto field = read_chart_formula(reading, item);
  return field ? std::optional(field->text()) : std::nullopt;
}

// The formulas are valid expressions, so the only possible error is their differentiation. The chart does not name the
// wrong one: each is tried alone.
void report_chart(Reading& reading, const Item& item, const Formulas& formulas) {
  for (std::size_t i = 0; i < 3; ++i) try {
      const geometry::Chart alone({formulas[i], "0", "0"}, reading.constants);
    } catch (const geometry::NotDifferentiable& error) {
      report_not_differentiable(reading, {item.value.as_array()[i], fmt::format("entry {} of {}", i + 1, item.name)},
                                error);
    } catch (const geometry::ExpressionError& error) {
      reading.report(item.value.as_array()[i], error.what());
    }
}

/// Reads a chart; without the name of a region it is the chart of all regions.
void read_chart(const Table& geometry, const Item& item, const std::string& region, problem::Problem& problem,
                nlohmann::json& effective) {
  Reading& reading = geometry.reading();
  const auto list = read_list(reading, item, Kind::formulas, 3, read_formula);
  if (!list) return;
  const Formulas formulas{(*list)[0], (*list)[1], (*list)[2]};
  try {
    const geometry::Chart chart(formulas, reading.constants);
    problem.charts.insert_or_assign(region, chart);
    effective = formulas;
  } catch (const geometry::ExpressionError&) {
    report_chart(reading, item, formulas);
  }
}

void report_unknown_region(Reading& reading, const std::string& region, const toml::value& value,
                           const std::vector<std::string>& regions) {
  const bool unnamed = regions == std::vector<std::string>{""};
  reading.report(reading.source.key(region, value),
                 fmt::format("the domain has no region \"{}\"", geometry::shortened(region)),
                 unnamed ? "" : joined(regions),
                 unnamed ? "the domain is one region without a name: write chart = [three expressions]"
                         : did_you_mean(region, regions));
}

// Reads a table of charts by region. The regions of a mesh file are known only when it is read.
void read_charts_by_region(const Table& geometry, const toml::value& table, const std::vector<std::string>& regions,
                           problem::Problem& problem, nlohmann::json& effective) {
  Reading& reading = geometry.reading();
  effective = nlohmann::json::object();
  for (const auto& [region, value] : entries(reading, table)) {
    if (!regions.empty() && std::ranges::count(regions, region) == 0) {
      report_unknown_region(reading, region, value, regions);
      continue;
    }
    read_chart(geometry, Item{value, fmt::format("the chart of {}", geometry::shortened(region))}, region, problem,
               effective[region]);
  }
  if (table.as_table().empty()) geometry.report("chart", "chart is an empty table", description(Kind::formulas));
  if (regions == std::vector<std::string>{""}) return;
  for (const std::string& region : regions)
    if (table.as_table().count(region) == 0)
      geometry.report("chart", fmt::format("the region \"{}\" has no chart", geometry::shortened(region)),
                      joined(regions));
}

void read_charts(Table& geometry, const domain::Domain& domain, problem::Problem& problem) {
  const auto given = geometry.value("chart");
  if (!given) return;
  const auto regions = domain::region_names(domain);
  auto& effective = geometry.effective["chart"];
  if (given->is_table())
    read_charts_by_region(geometry, *given, regions, problem, effective);
  else
    read_chart(geometry, Item{*given, "chart"}, "", problem, effective);
}

}  // namespace

std::vector<Section> geometry_sections() {
  std::vector<Section> all{
      {"geometry",
       "[geometry]",
       "The mid-surface is the image of a plane domain under the chart, or the cells of a mesh in space.",
       {key("domain", Kind::table, {.example = "{ disk = { radius = 1 } }"}, "the domain of the parameters x, y"),
        key("chart", Kind::formulas, {.unit = "m", .example = "[\"x\", \"y\", \"0\"]"},
            "three expressions: the point of the mid-surface at x, y. For a domain with named regions also a table "
            "region = [three expressions]. Required with domain"),
        key("file", Kind::text, {},
            "instead of domain and chart: a mesh in space, whose quadrilaterals or triangles are the mid-surface. A "
            "Gmsh file (.msh, format 2.2 or 4.1, ASCII, order 1 to 10). Physical surfaces name the regions, physical "
            "curves name the boundaries. Expressions then use X, Y, Z. Mesh curved parts with order 2 or more. A CAD "
            "file "
            "(.step, .stp, .brep) is meshed on its true faces: methods/cad.md. Facets (.stl, .obj, .ply) are remeshed, "
            "with the error that facets have: methods/surface-meshes.md"),
        key("unit", &SpaceReading::file_unit,
            {{"m", 1.0}, {"dm", 0.1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}}, {},
            "of a CAD file: the unit of its lengths. Only where the file does not name one, or names a wrong one. "
            "Lengths are converted to the length of [units], or to m"),
        key("faces", Kind::table, {.shorthand = Kind::name_or_names},
            "of a CAD file: the faces that are the shell; also written as a name or a list of names. If not given, "
            "all"),
        key("solids", Kind::word, {.fallback = "\"middle\"", .words = {"middle", "faces"}},
            "of a CAD file with solids. middle: a thin solid, whose faces are opposite to each other at one distance, "
            "is the "
            "surface in the middle between them. faces: its faces are the shell"),
        key("size", &SpaceReading::size, &Table::number_or_none,
            {.kind = Kind::number, .unit = "m", .range = Range::positive()},
            "sides of the cells that are made on faces of a CAD file or from facets. If not given: about 200 on a "
            "part, "
            "2000 for facets, or smaller ones where these fold at small features. "
            "`plastron check` prints it"),
        key("scale", &SpaceReading::scale, {.fallback = "1", .range = Range::positive()},
            "factor from the lengths of the file to those of the case: 1e-3 for a file in millimetres"),
        key("upper", &SpaceReading::upper, &Table::direction_or_none, {.kind = Kind::vector},
            "direction to which the normal a3 points, on average. If not given, a3 of a closed surface points "
            "outwards, that of others to the side of most cells of the file"),
        key("smooth", &SpaceReading::smooth_angle, &Table::angle_or_none,
            {.kind = Kind::number, .unit = "degrees", .range = Range::between(0, 170)},
            "cells that meet at a smaller angle are smooth there, others are a fold. If not given: 1 for CAD files, 10 "
            "for cells "
            "of order 2 or more, 30 for facets and other cells with straight sides"),
        key("folds", &SpaceReading::folds, {.fallback = "[]"}, "names of curves that are folds, whatever their angle"),
        key("tolerance", &SpaceReading::tolerance, &Table::number_or_none,
            {.kind = Kind::number, .unit = "m", .range = Range::positive()},
            "nodes, and edges of a CAD file, nearer to each other than this are one. If not given: 1e-9 of the extent, "
            "for CAD "
            "files 1e-6"),
        key("offset", Kind::number, {.fallback = "0", .range = Range::between(-1, 1)},
            "distance of the mid-surface from the surface of the file along a3, as a part of the thickness: 0.5 if the "
            "file is the lower face, -0.5 if it is the upper one. Only without folds"),
        key("slits", &SpaceReading::has_slits, {.fallback = "false"},
            "true: edges may run beside each other without being joined; otherwise such a gap is an error")},
       {"domain", "file"},
       "",
       {{"domain", "chart"}, {"chart", "domain"}}}};
  std::ranges::move(domain_sections(), std::back_inserter(all));
  return all;
}

namespace {

/// Reads a mesh in space.
std::optional<domain::Domain> read_file(Table& geometry) {
  for (const char* name : {"domain", "chart"})
    if (geometry.has(name))
      geometry.report_key(name, fmt::format("[geometry] has both {} and file", name), "domain and chart, or file",
                          "a mesh in space needs no formulas: remove one of them");
  domain::MeshFile file;
  SpaceReading reading;
  const bool is_right = geometry.fill(reading);
  reading.offset.part = geometry.number("offset").value_or(0);
  const auto path = read_mesh_path(geometry, "file");
  if (!path || !is_right) return {};
  const bool is_part = domain::is_cad_file(*path);
  if (is_part && reading.scale != 1)
    geometry.report_key("scale", "a CAD file has a unit, from which its lengths are converted", "",
                        "remove scale, and write [units] with length = \"mm\" to compute in mm");
  if (is_part && !reading.folds.empty())
    geometry.report_key("folds", "folds of a CAD file are edges where its faces meet at an angle above smooth", "",
                        "remove folds");
  if (!is_part && geometry.has("unit"))
    geometry.report_key("unit", "unit is for CAD files; a mesh has numbers only", "",
                        "write scale = 1e-3 for a mesh in mm");
  if (reading.size && !is_part && !geometry::is_triangle_file(*path)) {
    geometry.report("size",
                    fmt::format("size is given, but {} is a mesh, whose cells are taken as they are",
                                std::filesystem::path(*path).filename().string()),
                    "size only with CAD files and facets: .step, .brep, .stl, .obj, .ply",
                    "remove size, or mesh the part with other cells");
    return {};
  }
  file.path = *path;
  file.in_space = std::move(reading);
  geometry.reading().domain = file;
  read_chosen_faces(geometry);
  return file;
}

void refuse_keys_of_files(const Table& geometry) {
  for (const char* name :
       {"unit", "faces", "solids", "scale", "size", "upper", "smooth", "folds", "tolerance", "offset", "slits"})
    if (geometry.has(name))
      geometry.report_key(name, fmt::format("{} is a key of a mesh in space", name), "",
                          "name the mesh: file = \"part.msh\"");
}

}  // namespace

void read_geometry(Table& root, problem::Problem& problem) {
  root.in_table("geometry", [&](Table& geometry) {
    if (geometry.has("file")) {
      root.reading().domain = read_file(geometry);
      if (root.reading().domain) problem.domain = *root.reading().domain;
      return;
    }
    refuse_keys_of_files(geometry);
    geometry.require("domain");
    geometry.require("chart");
    const auto domain = read_domain(geometry);
    root.reading().domain = domain;
    if (domain) {
      problem.domain = *domain;
      read_charts(geometry, *domain, problem);
    } else if (const auto chart = geometry.value("chart"); chart && !chart->is_table()) {
      const Item item{*chart, "chart"};  // its own mistakes are found for any domain
      nlohmann::json unused;
      read_chart(geometry, item, "", problem, unused);
    }
  });
}

void complete_geometry(problem::Problem& problem) {
  auto* file = std::get_if<domain::MeshFile>(&problem.domain);
  if (!file || !file->in_space) return;
  for (const assembly::Support& support : problem.shell.supports)
    if (support.symmetry) file->in_space->symmetric.push_back(support.boundary);
  file->in_space->offset.thickness = problem.shell.sections.common.thickness;
  for (const auto& [region, section] : problem.shell.sections.regions)
    file->in_space->offset.by_region.insert_or_assign(region, section.thickness);
}

}  // namespace plastron::config
