#include <plastron/contact/problem.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <algorithm>

namespace plastron::io {

namespace {

template <class Record>
Part part(std::string place, std::string_view meaning, std::span<const Quantity<Record>> quantities) {
  Part part{std::move(place), meaning, {}};
  for (const auto& q : quantities) part.entries.push_back({q.path, q.unit, q.meaning, q.form});
  return part;
}

Form form_of(const Field& field) {
  return field.components == 1 ? Form::number : field.components == 2 ? Form::pair : Form::triple;
}

Part probes(std::string place, std::string_view meaning) {
  Part part{std::move(place), meaning, {}};
  for (const Field& f : fields())
    part.entries.push_back({f.key, f.unit, f.meaning, form_of(f), f.presence != Presence::always});
  return part;
}

}  // namespace

const std::vector<Part>& parts() {
  static const std::vector<Part> all{
      part("", "the whole result; with steps, the result of the last step", result_quantities()),
      part("linearity/quantities/*/", "numbers of the linear model beside those of finite rotations; empty if unknown",
           model_quantities()),
      part("modes/*/", "buckling loads and natural frequencies; empty unless [modes] asks for them", mode_quantities()),
      part("singular_places/*/", "places where stresses have no limit as the mesh is refined",
           singular_place_quantities()),
      part("layers/*/", "stresses by layer; empty without [[material]] that has layers or is orthotropic",
           layer_quantities()),
      part("supports/*/", "reaction at each supported boundary", support_quantities()),
      part("corner_supports/*/", "reaction at each corner where supported edges meet", corner_support_quantities()),
      part("point_supports/*/", "reaction at each supported point", point_support_quantities()),
      part("rigid_bodies/*/", "motion and reaction of each rigid body", rigid_body_quantities()),
      part("foundations/*/", "reaction of each foundation", foundation_quantities()),
      part("springs/*/", "reaction of each spring", foundation_quantities()),
      part("contact/", "contact with all obstacles; null without obstacle", contact_quantities()),
      part("contact/admissible/", "effect of lifted bounds; null unless contact.admissible = true",
           admissible_quantities()),
      part("obstacles/*/", "contact with each obstacle", obstacle_quantities()),
      part("obstacles/*/zones/*/", "each connected contact zone", zone_quantities()),
      part("history/*/", "state at the end of each part of the steps; empty without steps", history_quantities()),
      part("history/*/obstacles/*/", "contact with each obstacle at this instant", obstacle_quantities()),
      part("history/*/estimates/*/", "estimated errors at this instant; empty without [accuracy]",
           goal_record_quantities()),
      probes("probes/*/", "fields at each [[probe]], by its name"),
      probes("history/*/probes/*/", "fields at each [[probe]] at this instant"),
      part("estimates/", "estimated distance of the last solution from the exact one; null if it was not estimated",
           estimate_quantities()),
      part("estimates/goals/*/", "estimated error of each requested number", goal_quantities()),
      part("estimates/geometry/", "estimated distance of a mesh in space from the part; null on charts",
           geometry_quantities()),
      part("certificate/", "how well the result satisfies the equations", certificate_quantities()),
      part("levels/*/", "each mesh of the sequence", level_quantities()),
      part("levels/*/history/*/", "each active-set iteration on this mesh", iteration_quantities())};
  return all;
}

std::string dotted(std::string_view place, std::string_view path) {
  std::string result = std::string(place).append(path);
  std::ranges::replace(result, '/', '.');
  for (std::size_t at = 0; (at = result.find(".*")) != std::string::npos;)
    result.replace(at, 2, result.substr(0, at).ends_with("probes") ? ".NAME" : "[]");
  return result;
}

namespace {

Json list_of(Json entry) { return {{"type", "array"}, {"items", std::move(entry)}}; }
Json map_to(Json entry) { return {{"type", "object"}, {"additionalProperties", std::move(entry)}}; }
Json text() { return {{"type", "string"}}; }
Json text_or_null() { return {{"type", {"string", "null"}}}; }

Json numbers(std::size_t count) {
  return {{"type", "array"}, {"items", {{"type", {"number", "null"}}}}, {"minItems", count}, {"maxItems", count}};
}

Json schema_of(Form form) {
  switch (form) {
    case Form::number:
      return {{"type", {"number", "null"}}};
    case Form::integer:
      return {{"type", "integer"}};
    case Form::text:
      return text();
    case Form::flag:
      return {{"type", "boolean"}};
    case Form::pair:
      return numbers(2);
    case Form::triple:
      return numbers(3);
  }
  return Json::object();
}

Json statuses() {
  Json words = Json::array();
  for (const contact::Status status : contact::statuses()) words.push_back(contact::to_string(status));
  return words;
}

/// Adds a required property.
Json& member(Json& record, const std::string& name) {
  if (!record.contains("type")) record["type"] = "object";
  Json& required = record["required"];
  if (!required.is_array()) required = Json::array();
  if (std::find(required.begin(), required.end(), Json(name)) == required.end()) required.push_back(name);
  return record["properties"][name];
}

/// Returns the schema of the record with this place. It is made if necessary, including lists and tables by name.
Json& at_place(Json& schema, std::string_view place) {
  Json* node = &schema;
  while (!place.empty()) {
    const std::size_t end = place.find('/');
    const std::string name(place.substr(0, end));
    place.remove_prefix(end == std::string_view::npos ? place.size() : end + 1);
    if (name != "*") {
      node = &member(*node, name);
      if (place.starts_with('*')) (*node)["type"] = name == "probes" ? "object" : "array";
    } else {
      node = &(*node)[(*node)["type"] == "object" ? "additionalProperties" : "items"];
    }
  }
  return *node;
}

void add(Json& record, const Entry& entry) {
  Json value{
      {"description", std::string(entry.meaning) + (entry.unit == "-" ? "" : " [" + std::string(entry.unit) + "]")}};
  value.update(schema_of(entry.form));
  if (entry.path == "status") value["enum"] = statuses();
  if (entry.can_be_absent) {
    if (!value["type"].is_array()) value["type"] = Json::array({value["type"]});
    if (std::find(value["type"].begin(), value["type"].end(), Json("null")) == value["type"].end())
      value["type"].push_back("null");
  }
  at_place(record, entry.path) = std::move(value);
}

/// Adds entries that belong to no table.
void add_others(Json& schema) {
  const auto add = [&](const char* name, const char* meaning, const Json& value) {
    Json described{{"description", meaning}};
    described.update(value);
    member(schema, name) = std::move(described);
  };
  add("title", "title of the case", text());
  add("warnings", "warnings about the result", list_of(text()));
  add("certificate_limits", "row of the certificate -> its limit, whether it holds, and the reason for the limit",
      map_to({{"type", "object"},
              {"required", {"unit", "holds", "reason"}},
              {"properties",
               {{"at_least", {{"type", {"number", "null"}}}},
                {"at_most", {{"type", {"number", "null"}}}},
                {"unit", text()},
                {"holds", {{"type", "boolean"}}},
                {"reason", text()}}}}));
  member(at_place(schema, "history/*/"), "factors") = {
      {"description", "factors at this instant of names that have their own"},
      {"type", "object"},
      {"additionalProperties", {{"type", {"number", "null"}}}}};
  add("envelopes", "least and largest value over load cases of each number in history, and the cases that have them",
      list_of({{"type", "object"},
               {"required", {"name", "cases", "numbers"}},
               {"properties", {{"name", text()}, {"cases", list_of(text())}, {"numbers", map_to(Json::object())}}}}));
  add("settings", "the case with every default; see plastron schema", {{"type", {"object", "null"}}});
  add("versions", "versions of the program and its libraries", map_to(text()));
  add("files", "files beside results.json", list_of(text()));
  add("verification", "data for plastron verify",
      {{"type", "object"},
       {"required", {"solution", "case"}},
       {"properties", {{"solution", text_or_null()}, {"case", {{"type", {"object", "null"}}}}}}});
  add("fields", "the arrays of the .vtu file", list_of(map_to(Json::object())));
  add("units", "path -> unit of every number", map_to(text()));
  add("unit_names", "names of length and force, from [units]", map_to(text()));
}

}  // namespace

Json results_schema() {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
              {"title", "results.json of Plastron"},
              {"type", "object"}};
  for (const Part& part : parts()) {
    Json& record = at_place(schema, part.place);
    if (!part.place.empty()) record["description"] = part.meaning;
    if (!record.contains("type")) record["type"] = "object";
    for (const Entry& entry : part.entries) add(record, entry);
  }
  Json& contact = schema["properties"]["contact"];
  contact["type"] = contact["properties"]["admissible"]["type"] = Json::array({"object", "null"});
  Json& estimates = schema["properties"]["estimates"];
  estimates["type"] = estimates["properties"]["geometry"]["type"] = Json::array({"object", "null"});
  add_others(schema);
  return schema;
}

}  // namespace plastron::io
