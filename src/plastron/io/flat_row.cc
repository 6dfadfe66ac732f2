#include <plastron/io/flat_row.hpp>

#include <plastron/io/fields.hpp>
#include <plastron/io/results_schema.hpp>

#include <algorithm>
#include <array>

namespace plastron::io {

namespace {

bool is_list_of_numbers(const Json& value) {
  return value.is_array() &&
         std::ranges::all_of(value, [](const Json& entry) { return entry.is_number() || entry.is_null(); });
}

/// Returns the name of a component; components of tensors have the same names as in the fields.
std::string component_name(const std::string& path, std::size_t k, std::size_t count) {
  static constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  for (const Field& field : fields()) {
    const std::string key = dotted("", field.key);
    if (field.arrays.size() == count && path.starts_with("probes.") && path.ends_with("." + key))
      return path.substr(0, path.size() - key.size()) + field.arrays[k];
  }
  return path + "_" + (count == axes.size() ? axes.at(k) : std::to_string(k + 1));
}

/// Returns the name of a part of a list, else the boundary to which it belongs, else its number.
std::string name_in_list(const Json& part, std::size_t number) {
  for (const char* key : {"name", "boundary"})
    if (part.is_object() && part.contains(key) && part[key].is_string()) return part[key].get<std::string>();
  return std::to_string(number);
}

void flatten(const Json& value, const std::string& path, Row& row) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items())
      if (key != "name") flatten(entry, prefix + key, row);
  } else if (value.is_array() && !is_list_of_numbers(value)) {
    for (std::size_t k = 0; k < value.size(); ++k) flatten(value[k], prefix + name_in_list(value[k], k), row);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) flatten(value[k], component_name(path, k, value.size()), row);
  } else {
    row.emplace_back(path, value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump());
  }
}

}  // namespace

Row flat_row(const Json& record) {
  Row row;
  flatten(record, "", row);
  return row;
}

Row result_row(Json results) {
  for (const char* part : {"title", "warnings", "certificate_limits", "settings", "versions", "files", "verification",
                           "fields", "units", "unit_names", "levels", "history", "memory"})
    results.erase(part);
  if (results.contains("linearity") && results["linearity"].is_object()) results["linearity"].erase("seconds");
  return flat_row(results);
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace plastron::io
