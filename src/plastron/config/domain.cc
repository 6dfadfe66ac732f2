// Reads [geometry] domain.
#include <plastron/config/printable.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>
#include <filesystem>

namespace plastron::config {

namespace {

using Domain = std::optional<fem::Domain>;

bool check_breaks(const Table& rectangle, const fem::Rectangle& r) {
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

bool check_regions(const Table& rectangle, const fem::Rectangle& r) {
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

Domain read_rectangle(Table& rectangle) {
  const auto from = rectangle.point("from"), to = rectangle.point("to");
  const auto cells = rectangle.cell_counts("cells");
  const auto breaks = rectangle.numbers("breaks");
  const auto regions = rectangle.texts("regions");
  if (!from || !to || !breaks || !regions || (rectangle.has("cells") && !cells)) return {};
  const fem::Rectangle r{*from, *to, cells.value_or(std::array{0, 0}), *breaks, *regions};
  if (static_cast<double>(r.cells[0]) * r.cells[1] > most_cells) {
    rectangle.report("cells", fmt::format("{} x {} cells on the coarsest mesh", r.cells[0], r.cells[1]),
                     fmt::format("at most {:.0f} together", most_cells), "refine with mesh.refinements instead");
    return {};
  }
  if (!(r.from.array() < r.to.array()).all()) {
    rectangle.report("to", fmt::format("to = [{}, {}] does not lie right of and above from = [{}, {}]", r.to[0],
                                       r.to[1], r.from[0], r.from[1]));
    return {};
  }
  return check_breaks(rectangle, r) && check_regions(rectangle, r) ? Domain(r) : std::nullopt;
}

Domain read_disk(Table& disk) {
  const auto centre = disk.point("centre");
  const auto radius = disk.number("radius");
  return centre && radius ? Domain(fem::Disk{*centre, *radius}) : std::nullopt;
}

Domain read_annulus(Table& annulus) {
  const auto centre = annulus.point("centre");
  const auto inner = annulus.number("inner"), outer = annulus.number("outer");
  if (!centre || !inner || !outer) return {};
  if (*inner < *outer) return fem::Annulus{*centre, *inner, *outer};
  annulus.report("inner", fmt::format("the radius inner = {} is not less than outer = {}", *inner, *outer),
                 "0 < inner < outer");
  return {};
}

std::optional<Eigen::Vector2d> read_point(Reading& reading, const Item& item) {
  const auto list = read_list(reading, item, Kind::point, 2, read_number);
  if (!list) return {};
  return Eigen::Vector2d((*list)[0], (*list)[1]);
}

// Reads polygon = { corners = [...] } or polygon = [...].
Domain read_polygon(Table& domain) {
  toml::value corners = domain.value("polygon").value();
  if (corners.is_table()) {
    const auto given = domain.table("polygon")->value("corners");
    if (!given) return {};
    corners = *given;
  }
  Reading& reading = domain.reading();
  const auto points = read_list(reading, Item{corners, "corners"}, Kind::points, 0, read_point);
  if (!points) return {};
  const std::string fault = polygon_fault(*points);
  if (!fault.empty()) {
    reading.report(reading.source.value(corners), fault);
    return {};
  }
  auto& effective = domain.effective["polygon"]["corners"] = nlohmann::json::array();
  for (const auto& p : *points) effective.push_back({p[0], p[1]});
  return fem::Polygon{*points};
}

Domain read_mesh_file(Table& domain) {
  const auto name = domain.text("mesh");
  if (!name) return {};
  if (has_control_characters(*name) || name->empty()) {
    domain.report("mesh", name->empty() ? "the path of the mesh file is empty" : "the path has a control character");
    return {};
  }
  const auto path = domain.reading().file(*name);
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return fem::MeshFile{path.string()};
  const bool is_there = std::filesystem::exists(path, error);
  domain.report("mesh",
                is_there ? fmt::format("{} is a directory, a pipe or a device, not a mesh file", path.string())
                         : fmt::format("there is no mesh file {}", path.string()),
                "", is_there ? "name a Gmsh file (.msh)" : "the path is relative to the folder of the case file");
  return {};
}

}  // namespace

std::optional<fem::Domain> read_domain(Table& geometry) {
  auto domain = geometry.table("domain");
  if (!domain) return {};
  std::vector<std::string> given;
  const auto shapes = names(section("geometry.domain").keys);
  std::ranges::copy_if(shapes, std::back_inserter(given), [&](const std::string& name) { return domain->has(name); });
  if (given.size() != 1) {
    if (given.empty())
      geometry.report("domain", "domain names no shape", joined(shapes),
                      "for example domain = { disk = { radius = 1 } }");
    else
      domain->reading().report(domain->key_place(given[1]),
                               fmt::format("domain has both {} and {}", given[0], given[1]),
                               fmt::format("one of {}", joined(shapes)));
    return {};
  }
  Domain result;
  if (given[0] == "polygon") {
    result = read_polygon(*domain);
  } else if (given[0] == "mesh") {
    result = read_mesh_file(*domain);
  } else if (auto shape = domain->table(given[0])) {
    result = given[0] == "rectangle" ? read_rectangle(*shape)
             : given[0] == "disk"    ? read_disk(*shape)
                                     : read_annulus(*shape);
    domain->effective[given[0]] = shape->effective;
  }
  geometry.effective["domain"] = domain->effective;
  return result;
}

}  // namespace plastron::config
