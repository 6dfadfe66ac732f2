// Reads [constants].
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>
#include <cctype>
#include <limits>

namespace plastron::config {

namespace {

bool is_identifier(const std::string& name) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && letter(name[0]) && std::ranges::all_of(name, [&](char c) { return letter(c) || digit(c); });
}

// Names with a meaning in the libraries for expressions.
bool is_taken(const std::string& name) {
  static const std::vector<std::string> more{"sq",  "cube", "step", "log2", "log10", "rint",
                                             "sum", "avg",  "Pi",   "I",    "Euler", "Catalan"};
  return std::ranges::count(expression_names(), name) + std::ranges::count(more, name) > 0;
}

bool check_name(Reading& reading, const std::string& name, const toml::value& value) {
  const Place place = reading.source.key(name, value);
  if (!is_identifier(name) || name.size() > longest_name) {
    reading.report(place, fmt::format("\"{}\" cannot name a constant", geometry::shortened(name)),
                   fmt::format("letters, digits and _, the first no digit, at most {} of them", longest_name));
    return false;
  }
  if (!is_taken(name)) return true;
  reading.report(place, fmt::format("\"{}\" has a meaning in expressions and cannot name a constant", name), "",
                 "choose another name");
  return false;
}

}  // namespace

std::vector<Section> constants_sections() {
  return {{"constants",
           "[constants]",
           "Each key is the name of a constant. Its value is a number or an expression of the constants above it. A "
           "name has at most 60 letters, digits and _, and does not begin with a digit. These names are not allowed: "
           "x, y, X, Y, Z, pi, the names of functions, and log2, log10, rint, sum, avg, sq, cube, step, Pi, I, Euler, "
           "Catalan, "
           "which the libraries for expressions use.",
           {}}};
}

void read_constants(Table& root) {
  Reading& reading = root.reading();
  nlohmann::json& effective = root.effective["constants"] = nlohmann::json::object();
  const toml::value table = root.value("constants").value();
  if (!table.is_table()) {
    report_kind(reading, Item{table, "constants"}, Kind::table);
    reading.constants_complete = false;
    return;
  }
  const auto all = entries(reading, table);
  for (const auto& [name, value] : all) reading.later_constants.push_back(name);
  for (const auto& [name, value] : all) {
    if (!check_name(reading, name, value)) {
      reading.constants_complete = false;
      continue;
    }
    const auto number = read_number(reading, Item{value, name});
    reading.constants.emplace_back(name, number.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (number)
      effective[name] = *number;
    else
      reading.constants_complete = false;
    std::erase(reading.later_constants, name);
  }
  reading.later_constants.clear();
}

}  // namespace plastron::config
