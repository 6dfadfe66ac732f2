// Reads [geometry] domain: a shape or a mesh file.
#include <plastron/config/printable.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <filesystem>

namespace plastron::config {

namespace {

using Domain = std::optional<domain::Domain>;

bool check_breaks(const Table& rectangle, const domain::Rectangle& r) {
  double last = r.from[0];
  for (const double x : r.breaks) {
    if (x <= last || x >= r.to[0]) {
      rectangle.report("breaks", fmt::format("the break {} is not in order between the sides", x),
                       fmt::format("ascending numbers between {} and {}", r.from[0], r.to[0]));
      return false;
    }
    last = x;
  }
  return true;
}

bool check_regions(const Table& rectangle, const domain::Rectangle& r) {
  if (r.breaks.empty() && r.regions.empty()) return true;
  if (r.regions.size() != r.breaks.size() + 1) {
    rectangle.report(
        rectangle.has("regions") ? "regions" : "breaks",
        fmt::format("{} regions are named, but the breaks make {}", r.regions.size(), r.breaks.size() + 1));
    return false;
  }
  for (const std::string& name : r.regions) {
    const bool repeated = std::ranges::count(r.regions, name) > 1;
    if (!name.empty() && !repeated) continue;
    rectangle.report("regions", repeated ? fmt::format("two regions are named \"{}\"", name) : "a region has no name");
    return false;
  }
  if (r.cells[0] == 0 || r.cells[0] >= static_cast<int>(r.regions.size())) return true;
  rectangle.report("cells", fmt::format("{} cells along x cannot cover {} regions", r.cells[0], r.regions.size()),
                   fmt::format("{} or more along x", r.regions.size()));
  return false;
}

/// Checks a rectangle whose keys are read.
bool is_valid(const Table& rectangle, const domain::Rectangle& r) {
  if (static_cast<double>(r.cells[0]) * r.cells[1] > most_cells) {
    rectangle.report("cells", fmt::format("{} x {} cells on the coarsest mesh", r.cells[0], r.cells[1]),
                     fmt::format("at most {:.0f} together", most_cells), "refine with mesh.refinements instead");
    return false;
  }
  if (!(r.from.array() < r.to.array()).all()) {
    rectangle.report("to", fmt::format("to = [{}, {}] does not lie right of and above from = [{}, {}]", r.to[0],
                                       r.to[1], r.from[0], r.from[1]));
    return false;
  }
  return check_breaks(rectangle, r) && check_regions(rectangle, r);
}

bool is_valid(const Table& /*disk*/, const domain::Disk& /*d*/) { return true; }

bool is_valid(const Table& annulus, const domain::Annulus& a) {
  if (a.inner < a.outer) return true;
  annulus.report("inner", fmt::format("the radius inner = {} is not less than outer = {}", a.inner, a.outer),
                 "0 < inner < outer");
  return false;
}

/// Reads a shape whose keys all go to members.
template <class Shape>
Domain read_members(Table& domain, const std::string& name) {
  Domain result;
  domain.in_table(name, [&](Table& table) {
    Shape shape;
    if (table.fill(shape) && is_valid(table, shape)) result = shape;
  });
  return result;
}

// Reads polygon = { corners = [...] } or polygon = [...].
Domain read_polygon(Table& domain) {
  std::optional<toml::value> given = domain.value("polygon");
  if (given->is_table()) domain.in_table("polygon", [&](Table& polygon) { given = polygon.value("corners"); });
  if (!given) return {};
  const toml::value& corners = *given;
  Reading& reading = domain.reading();
  const auto points = read_list(reading, Item{corners, "corners"}, Kind::points, 0, read_vector<2>);
  if (!points) return {};
  const std::string fault = polygon_fault(*points);
  if (!fault.empty()) {
    reading.report(corners, fault);
    return {};
  }
  auto& effective = domain.effective["polygon"]["corners"] = nlohmann::json::array();
  for (const auto& p : *points) effective.push_back({p[0], p[1]});
  return domain::Polygon{*points};
}

Domain read_mesh_file(Table& domain) {
  const auto path = read_mesh_path(domain, "mesh");
  return path ? Domain(domain::MeshFile{.path = *path}) : Domain();
}

}  // namespace

std::optional<std::string> read_path(Table& table, const std::string& key, const std::string& what,
                                     const std::string& advice) {
  const auto name = table.text(key);
  if (!name) return {};
  if (has_control_characters(*name) || name->empty()) {
    table.report(key,
                 name->empty() ? fmt::format("the path of the {} is empty", what) : "the path has a control character");
    return {};
  }
  const auto path = table.reading().file(*name);
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return path.string();
  const bool is_there = std::filesystem::exists(path, error);
  table.report(key,
               is_there ? fmt::format("{} is a directory, a pipe or a device, not a {}", path.string(), what)
                        : fmt::format("there is no {} {}", what, path.string()),
               "", is_there ? advice : "the path is relative to the folder of the case file");
  return {};
}

std::optional<std::string> read_mesh_path(Table& table, const std::string& key) {
  return read_path(table, key, "mesh file", "name a Gmsh file (.msh)");
}

std::vector<Section> domain_sections() {
  using domain::Rectangle, domain::Disk, domain::Annulus;
  return {
      {"geometry.domain",
       "domain",
       "Exactly one of these keys is given.",
       {key("rectangle", Kind::table, {}, "boundaries left, right, bottom, top (x min, x max, y min, y max)"),
        key("disk", Kind::table, {}, "boundary rim"), key("annulus", Kind::table, {}, "boundaries inner, outer"),
        key("polygon", Kind::table, {.shorthand = Kind::points},
            "boundaries edge1 (from corner 1 to corner 2), edge2, ...; also written polygon = [corners]"),
        key("mesh", Kind::text, {},
            "a Gmsh file (.msh, format 2.2 or 4.1, ASCII) of quadrilaterals or triangles in the plane; its path is "
            "relative to the case file. Physical surfaces name the regions, physical curves name the boundaries. A "
            "curve may lie inside the domain; there the conormal n of supports points to the right of the curve as "
            "drawn. A curve may belong to several groups; then all of them act on it. A change of direction of more "
            "than one degree along a boundary is a corner, so mesh curved boundaries with order 2 or more")},
       {"rectangle", "disk", "annulus", "polygon", "mesh"}},
      {"geometry.domain.rectangle",
       "rectangle",
       "A rectangle. It may be divided into regions side by side.",
       {key("from", &Rectangle::from, {.fallback = "[0, 0]"}, "corner with the least x and y"),
        key("to", &Rectangle::to, {.required = true, .example = "[1, 1]"}, "corner with the greatest x and y"),
        key("cells", &Rectangle::cells, {.range = Range::between(1, 10000)},
            "numbers of cells of the coarsest mesh along x and y; if not given, the cells are nearly square"),
        key("breaks", &Rectangle::breaks, {.fallback = "[]"}, "x of the borders between regions, in ascending order"),
        key("regions", &Rectangle::regions, {.fallback = "[]"},
            "names of the regions from left to right, one more than the number of breaks")}},
      {"geometry.domain.disk",
       "disk",
       "A disk.",
       {key("centre", &Disk::centre, {.fallback = "[0, 0]"}, "its centre"),
        key("radius", &Disk::radius, {.required = true, .range = Range::positive(), .example = "1"}, "its radius")}},
      {"geometry.domain.annulus",
       "annulus",
       "A disk with a concentric hole.",
       {key("centre", &Annulus::centre, {.fallback = "[0, 0]"}, "its centre"),
        key("inner", &Annulus::inner, {.required = true, .range = Range::positive(), .example = "0.5"},
            "radius of the hole"),
        key("outer", &Annulus::outer, {.required = true, .range = Range::positive(), .example = "1"},
            "outer radius, greater than inner")}},
      {"geometry.domain.polygon",
       "polygon",
       "A polygon whose sides do not cross.",
       {key("corners", Kind::points, {.required = true, .example = "[[0, 0], [1, 0], [0, 1]]"},
            "three to 500 corners, clockwise or counter-clockwise")}}};
}

std::optional<domain::Domain> read_domain(Table& geometry) {
  Domain result;
  geometry.in_table("domain", [&](Table& domain) {
    const auto shape = domain.shape("domain = { disk = { radius = 1 } }");
    if (shape == "rectangle") result = read_members<domain::Rectangle>(domain, *shape);
    if (shape == "disk") result = read_members<domain::Disk>(domain, *shape);
    if (shape == "annulus") result = read_members<domain::Annulus>(domain, *shape);
    if (shape == "polygon") result = read_polygon(domain);
    if (shape == "mesh") result = read_mesh_file(domain);
  });
  return result;
}

}  // namespace plastron::config
