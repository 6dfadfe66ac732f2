// Reads the keys of a CAD file: the faces that are the shell, and names for faces and edges. They become the job of the program
// plastron-cad (apps/cad/job.hpp).
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

using nlohmann::json;

std::vector<Key> conditions(const char* things) {
  return {key("name", Kind::name_or_names, {}, fmt::format("names of {}", things)),
          key("where", Kind::text, {.example = "\"Z > 10\""},
              fmt::format("a condition in X, Y, Z, in lengths of the case, that holds on the whole outline of the {}",
                          things)),
          key("at", Kind::vector, {.unit = "m"}, fmt::format("a point, to which the {} are nearest", things)),
          key("colour", Kind::text, {.example = "\"#ff0000\""}, "of faces: their colour in the file")};
}

Section selector_section(const char* path, const char* header, const char* meaning) {
  return {path, header, meaning, conditions("faces")};
}

bool is_part(const Table& table) {
  const auto& domain = table.reading().domain;
  const auto* file = domain ? std::get_if<domain::MeshFile>(&*domain) : nullptr;
  return file && domain::is_cad_file(file->path);
}

/// A condition of X, Y, Z, which plastron-cad evaluates.
void read_condition(Table& table, json& selector) {
  if (!table.has("where")) return;
  const auto text = table.text("where");
  if (!text) return;
  try {
    const geometry::Expression expression(*text, table.reading().constants);
    if (expression.uses_parameters())
      return table.report("where", "x and y are places in a plane domain; a part has X, Y, Z", "X, Y, Z and constants");
    selector["where"] = *text;
  } catch (const geometry::ExpressionError& error) {
    table.report("where", error.what());
  }
}

void read_colour(Table& table, json& selector) {
  if (!table.has("colour")) return;
  auto colour = table.text("colour");
  if (!colour) return;
  std::ranges::transform(*colour, colour->begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) != 0; };
  if (colour->size() != 7 || colour->front() != '#' || !std::all_of(colour->begin() + 1, colour->end(), is_digit))
    return table.report("colour", fmt::format("\"{}\" is no colour", *colour),
                        "red, green and blue in hexadecimal digits: \"#ff0000\"",
                        "`plastron parts` lists the colours of the file");
  selector["colour"] = *colour;
}

void read_conditions_of_edges(Table& table, json& selector) {
  for (const char* key : {"between", "of"})
    if (table.has(key))
      if (const auto names = table.name_list(key, "face or region", {})) selector[key] = *names;
  if (table.has("free"))
    if (const auto free = table.boolean("free")) selector["free"] = *free;
}

/// Reads a selector of `things`, faces or edges: a name, a list of names, or a table of conditions, which must all hold.
json read_selector(Table& parent, const std::string& name, const char* things) {
  const auto given = parent.value(name);
  if (!given) return {};
  if (!given->is_table()) {
    const auto names = parent.name_list(name, things, {});
    return names ? json(*names) : json();
  }
  json selector = json::object();
  parent.in_table(name, [&](Table& table) {
    if (given->as_table().empty())
      table.report_here(fmt::format("{} has no condition", name), "name, where, at and others",
                        "add for example where = \"Z > 10\"");
    if (table.has("name"))
      if (const auto names = table.name_list("name", things, {})) selector["name"] = *names;
    read_condition(table, selector);
    if (table.has("at"))
      if (const auto at = table.vector("at")) selector["at"] = {(*at)[0], (*at)[1], (*at)[2]};
    if (name == "edges")
      read_conditions_of_edges(table, selector);
    else
      read_colour(table, selector);
  });
  return selector;
}

void report_without_part(const Table& table, const std::string& key) {
  table.report_key(key, fmt::format("{} chooses from a CAD file, and [geometry] has none", key), "",
                   "name the part: file = \"part.step\", or let the mesh program name it");
}

}  // namespace

std::vector<Section> cad_sections() {
  std::vector<Key> of_edges = conditions("edges");
  of_edges.pop_back();  // edges have no colours
  for (Key& more : std::vector{key("between", Kind::name_or_names, {.example = "[\"bottom\", \"fillet\"]"},
                                   "regions or faces that all meet at the edges"),
                               key("of", Kind::name_or_names, {}, "the same with one region or face: its edges"),
                               key("free", Kind::boolean, {}, "true: edges of a single face; false: of several")})
    of_edges.push_back(std::move(more));
  return {
      selector_section("geometry.faces", "faces", "Faces of a CAD file on which all the conditions hold."),
      selector_section("region.faces", "faces", "Faces of a CAD file on which all the conditions hold."),
      {"boundary",
       "[[boundary]]",
       "A name for edges of a CAD file. Without it, edges are \"edge 1\", \"edge 2\", ...: `plastron parts` lists "
       "them.",
       {key("name", Kind::name, {.required = true, .example = "\"rim\""}, "the name, for supports, loads and others"),
        key("edges", Kind::table,
            {.required = true, .example = "{ where = \"Z > 10\" }", .shorthand = Kind::name_or_names},
            "the edges; also written as a name or a list of names")}},
      {"boundary.edges", "edges", "Edges of a CAD file on which all the conditions hold.", std::move(of_edges)}};
}

void read_chosen_faces(Table& geometry) {
  for (const char* name : {"faces", "solids"})
    if (geometry.has(name) && !is_part(geometry)) return report_without_part(geometry, name);
  if (!is_part(geometry)) return;
  if (geometry.text("solids") == "faces") geometry.reading().part["skins"] = true;
  if (!geometry.has("faces")) return;
  geometry.reading().part["faces"] = read_selector(geometry, "faces", "face");
}

void read_faces_of_region(Table& region, const std::optional<std::string>& name) {
  if (!region.has("faces")) return;
  if (!is_part(region)) return report_without_part(region, "faces");
  json selector = read_selector(region, "faces", "face");
  if (name) region.reading().part["regions"].push_back({{"name", *name}, {"selector", std::move(selector)}});
}

void read_named_edges(Table& root) {
  root.in_tables("boundary", [&](Table& boundary) {
    if (root.reading().domain && !is_part(root)) return report_without_part(boundary, "edges");
    const auto name = boundary.known_name("name", "boundary", {});
    boundary.require("edges");
    if (!boundary.has("edges")) return;
    json selector = read_selector(boundary, "edges", "edge");
    for (const json& known : root.reading().part.value("boundaries", json::array()))
      if (name && known["name"] == *name)
        boundary.report("name", fmt::format("two [[boundary]] are named \"{}\"", *name), "",
                        "write one with a list of names, or choose another name");
    if (name) root.reading().part["boundaries"].push_back({{"name", *name}, {"selector", std::move(selector)}});
  });
}

void complete_part(Table& root, problem::Problem& problem) {
  auto* file = std::get_if<domain::MeshFile>(&problem.domain);
  if (!file || !file->in_space || !domain::is_cad_file(file->path)) return;
  json job = root.reading().part;
  const problem::UnitNames& units = problem.output.units;
  const auto length = units.in_SI(0, 1);
  if (!length) {
    root.report_key(
        "units",
        fmt::format("the lengths of the part cannot be converted to \"{}\", whose size is not known", units.length),
        "m, dm, cm, mm, um, km, in, ft", "write one of them as length of [units]");
    return;
  }
  job["unit"] = *length;
  if (file->in_space->file_unit > 0) job["file_unit"] = file->in_space->file_unit;
  if (file->in_space->size) job["size"] = *file->in_space->size;
  if (file->in_space->tolerance) job["tolerance"] = *file->in_space->tolerance;
  if (const auto& thickness = problem.shell.sections.common.thickness; thickness.is_constant())
    job["thickness"] = thickness(0, 0);
  if (job.contains("regions"))
    for (json& region : job["regions"])
      if (const auto& thickness = problem.shell.sections.regions.at(region["name"]).thickness; thickness.is_constant())
        region["thickness"] = thickness(0, 0);
  if (file->in_space->offset.part != 0) job["offset"] = file->in_space->offset.part;
  for (const auto& [name, value] : root.reading().constants) job["constants"][name] = value;
  file->cad_job = job.dump();
}

}  // namespace plastron::config
