#include <plastron/config/schema.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <toml.hpp>

namespace plastron::config {

namespace {

using Schema = nlohmann::ordered_json;

Schema any_of(std::vector<Schema> choices) { return {{"anyOf", std::move(choices)}}; }
Schema text() { return {{"type", "string"}}; }

Schema list_of(Schema entry, int count = 0) {
  Schema list{{"type", "array"}, {"items", std::move(entry)}};
  if (count > 0) list["minItems"] = list["maxItems"] = count;
  list["maxItems"] = count > 0 ? static_cast<std::size_t>(count) : most_entries;
  return list;
}

/// Returns the schema of the number itself, which an expression may replace.
Schema number(const char* type, const Range& range) {
  Schema value{{"type", type}};
  if (std::isfinite(range.low)) value[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) value[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  return any_of({value, text()});
}

Schema word_of(const Key& key) {
  Schema value = text();
  if (!key.words.empty()) value["enum"] = key.words;
  return value;
}

bool is_declared(const std::string& path) {
  return std::ranges::find(sections(), path, &Section::path) != sections().end();
}

Schema reference(const std::string& path) { return {{"$ref", "#/definitions/" + path}}; }

/// Returns the schema of any names, with values as in supports: { u.z = 1 }, { u = [0, 0, 1] }.
Schema free_table() {
  const Schema value = any_of({number("number", {}), list_of(number("number", {}))});
  return {{"type", "object"},
          {"additionalProperties", any_of({value, {{"type", "object"}, {"additionalProperties", value}}})}};
}

Schema schema_of(const Key& key, Kind kind, const std::string& path) {
  const auto is = [kind](auto... kinds) { return ((kind == kinds) || ...); };
  Schema real = number("number", key.range), formula = any_of({{{"type", "number"}}, text()});
  if (is(Kind::text, Kind::name)) return text();
  if (is(Kind::word)) return word_of(key);
  if (is(Kind::word_or_false)) return any_of({word_of(key), {{"enum", {false}}}});
  if (is(Kind::boolean)) return {{"type", "boolean"}};
  if (is(Kind::integer)) return number("integer", key.range);
  if (is(Kind::integer_or_word)) return any_of({word_of(key), number("integer", key.range)});
  if (is(Kind::number, Kind::field)) return real;
  if (is(Kind::numbers)) return list_of(real);
  if (is(Kind::point)) return list_of(real, 2);
  if (is(Kind::place)) return any_of({list_of(real, 2), list_of(real, 3)});
  if (is(Kind::places)) return list_of(any_of({list_of(real, 2), list_of(real, 3)}));
  if (is(Kind::vector, Kind::field_vector)) return list_of(real, 3);
  if (is(Kind::vectors)) return list_of(list_of(real, 3));
  if (is(Kind::cell_counts)) return list_of(number("integer", key.range), 2);
  if (is(Kind::names)) return list_of(word_of(key));
  if (is(Kind::name_or_names)) return any_of({text(), list_of(text())});
  if (is(Kind::points)) return list_of(list_of(real, 2));
  if (is(Kind::space_formula)) return formula;
  if (is(Kind::formulas))
    return any_of({list_of(formula, 3), {{"type", "object"}, {"additionalProperties", list_of(formula, 3)}}});
  if (is(Kind::tables)) return list_of(reference(path));
  if (is_declared(path)) return reference(path);
  return is(Kind::table) ? Schema{{"type", "object"}} : free_table();
}

Schema schema_value(const toml::value& value) {
  if (value.is_boolean()) return value.as_boolean();
  if (value.is_integer()) return value.as_integer();
  if (value.is_floating()) return value.as_floating();
  if (value.is_string()) return value.as_string().str;
  Schema json = value.is_array() ? Schema::array() : Schema::object();
  if (value.is_array())
    for (const toml::value& entry : value.as_array()) json.push_back(schema_value(entry));
  else if (value.is_table())
    for (const auto& [name, entry] : value.as_table()) json[name] = schema_value(entry);
  return json;
}

Schema schema_value(const std::string& toml_text) {
  std::istringstream stream("value = " + toml_text);
  return schema_value(toml::parse(stream, "declaration").at("value"));
}

Schema property(const Section& section, const Key& key) {
  const std::string path = section.path.empty() ? key.name : section.path + "." + key.name;
  Schema value = schema_of(key, key.kind, path);
  if (key.shorthand) value = any_of({std::move(value), schema_of(key, *key.shorthand, path)});
  // In this draft other keys beside $ref are ignored.
  if (value.contains("$ref")) value = {{"allOf", Schema::array({std::move(value)})}};
  const std::string range = key.range.text(key.name);
  Schema result{{"description",
                 key.meaning + (key.unit.empty() ? "" : " [" + key.unit + "]") + (range.empty() ? "" : "; " + range)}};
  if (!key.fallback.empty()) result["default"] = schema_value(key.fallback);
  if (!key.example.empty()) result["examples"] = Schema::array({schema_value(key.example)});
  result.update(value);
  return result;
}

Schema schema_of(const Section& section) {
  Schema table{{"description", section.meaning}, {"type", "object"}};
  if (section.keys.empty()) {  // [constants]
    table["propertyNames"] = {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}, {"maxLength", longest_name}};
    table["additionalProperties"] = number("number", {});
    return table;
  }
  Schema required = Schema::array();
  for (const Key& key : section.keys) {
    table["properties"][key.name] = property(section, key);
    if (key.required) required.push_back(key.name);
  }
  if (!required.empty()) table["required"] = required;
  for (const std::string& name : section.exactly_one) table["oneOf"].push_back({{"required", Schema::array({name})}});
  for (const auto& [name, needed] : section.needs) table["dependencies"][name] = Schema::array({needed});
  table["additionalProperties"] = section.other_keys.empty() ? Schema(false) : number("number", {});
  return table;
}

}  // namespace

nlohmann::ordered_json case_schema() {
  Schema schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "A case file of Plastron"}};
  schema.update(schema_of(section("")));
  for (const Section& s : sections())
    if (!s.path.empty()) schema["definitions"][s.path] = schema_of(s);
  return schema;
}

}  // namespace plastron::config
