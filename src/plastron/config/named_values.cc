#include <plastron/config/named_values.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

/// Whether a value names no component: one number, or a list that does not have three values.
bool names_no_component(Reading& reading, const std::string& name, const toml::value& value, const std::string& other) {
  if (value.is_table() || (value.is_array() && value.as_array().size() == 3)) return false;
  const std::string also = other.empty() ? "" : fmt::format(", {}.{} = ...", name, other);
  reading.report(reading.source.value(value),
                 value.is_array() ? fmt::format("{} has {} entries, but must have 3", name, value.as_array().size())
                                  : fmt::format("{} is a vector, and one value does not say which component", name),
                 fmt::format("{0}.x = ...{1} and their like, or {0} = [three values]", name, also),
                 fmt::format("for example values = {{ {0}.z = -0.02 }} or values = {{ {0} = [0, 0, -0.02] }}", name));
  return true;
}

}  // namespace

std::vector<NamedValue> named_values(Reading& reading, const toml::value& table,
                                     const std::vector<std::string>& vectors, const std::string& other) {
  std::vector<NamedValue> all;
  for (const auto& [name, value] : entries(reading, table)) {
    const bool is_vector = std::ranges::find(vectors, name) != vectors.end();
    if (is_vector && names_no_component(reading, name, value, other)) continue;
    if (value.is_table()) {
      for (const auto& [direction, inner] : entries(reading, value))
        all.push_back({fmt::format("{}.{}", name, direction), inner});
    } else if (value.is_array() && is_vector) {
      for (std::size_t i = 0; i < 3; ++i) all.push_back({fmt::format("{}.{}", name, "xyz"[i]), value.as_array()[i]});
    } else {
      all.push_back({name, value});
    }
  }
  return all;
}

}  // namespace plastron::config
