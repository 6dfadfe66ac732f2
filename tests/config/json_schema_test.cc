// The JSON Schema of the case file agrees with the declarations. tests/cli/validate_schemas.py checks it with a validator.
#include <gtest/gtest.h>
#include <plastron/config/schema.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace plastron::config {
namespace {

using Json = nlohmann::ordered_json;

const Json& of_section(const Json& schema, const std::string& path) {
  return path.empty() ? schema : schema["definitions"].at(path);
}

TEST(CaseSchema, HasEverySectionAndKey) {
  const Json schema = case_schema();
  for (const Section& section : sections()) {
    const Json& table = of_section(schema, section.path);
    if (section.keys.empty()) continue;
    EXPECT_EQ(table["additionalProperties"] == Json(false), section.other_keys.empty()) << section.path;
    EXPECT_EQ(table["properties"].size(), section.keys.size()) << section.path;
    for (const Key& key : section.keys) {
      ASSERT_TRUE(table["properties"].contains(key.name)) << section.path << "." << key.name;
      const bool is_required =
          table.contains("required") && std::ranges::find(table["required"], Json(key.name)) != table["required"].end();
      EXPECT_EQ(is_required, key.required) << section.path << "." << key.name;
    }
  }
}

void collect_references(const Json& json, std::set<std::string>& found) {
  if (json.is_object() && json.contains("$ref")) found.insert(json["$ref"].get<std::string>());
  for (const Json& part : json)
    if (part.is_structured()) collect_references(part, found);
}

TEST(CaseSchema, RefersToSectionsThatItHas) {
  const Json schema = case_schema();
  std::set<std::string> references;
  collect_references(schema, references);
  EXPECT_EQ(references.size(), sections().size() - 1) << "the file itself is referred to by none, all others are";
  for (const std::string& reference : references)
    EXPECT_TRUE(schema["definitions"].contains(reference.substr(std::string("#/definitions/").size()))) << reference;
}

TEST(CaseSchema, HasRangesAndWords) {
  const Json schema = case_schema();
  const Json nu = schema["definitions"]["shell"]["properties"]["nu"]["anyOf"][0];
  EXPECT_EQ(nu["minimum"], -0.999);
  EXPECT_EQ(nu["exclusiveMaximum"], 0.5);
  const Json& cells = schema["definitions"]["mesh"]["properties"]["cells"];
  EXPECT_EQ(cells["enum"], Json({"quadrilateral", "triangle"}));
  EXPECT_EQ(cells["default"], "quadrilateral");
}

TEST(Declarations, NameTheKeysOfWhichThereIsOne) {
  for (const Section& section : sections())
    for (const std::string& name : section.exactly_one)
      EXPECT_EQ(std::ranges::count(section.keys, name, &Key::name), 1) << section.path << "." << name;
}

}  // namespace
}  // namespace plastron::config
