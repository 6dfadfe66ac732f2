#include <plastron/io/history.hpp>

#include <plastron/io/fields.hpp>
#include <plastron/io/parts.hpp>
#include <plastron/io/results.hpp>

#include <algorithm>
#include <array>

namespace plastron::io {

namespace {

using Row = std::vector<std::pair<std::string, std::string>>;  // column, value

/// Returns the text in quotes if a comma, a quote or the end of a line would break the table.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

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

void flatten(const Json& value, const std::string& path, Row& row) {
  const std::string prefix = path.empty() ? "" : path + ".";
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items())
      if (key != "name") flatten(entry, prefix + key, row);
  } else if (value.is_array() && !is_list_of_numbers(value)) {
    for (const Json& entry : value) flatten(entry, prefix + entry.value("name", ""), row);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) flatten(value[k], component_name(path, k, value.size()), row);
  } else {
    row.emplace_back(path, value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump());
  }
}

std::string line(const Row& row, std::string Row::value_type::*what) {
  std::string text;
  for (const auto& cell : row) text += (text.empty() ? "" : ",") + quoted(cell.*what);
  return text + "\n";
}

}  // namespace

std::string history_csv(const computation::Result& result) {
  std::string text;
  for (const Json& entry : history_json(result)) {
    Row row;
    flatten(entry, "", row);
    if (text.empty()) text = line(row, &Row::value_type::first);
    text += line(row, &Row::value_type::second);
  }
  return text;
}

}  // namespace plastron::io
