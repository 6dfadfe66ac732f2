// Reads the entries of a table "values": { u.z = 1 }, { "u.z" = 1 } and { u = [0, 0, 1] } name components in the same
// way.
#pragma once
#include <plastron/config/reading.hpp>

#include <string>
#include <vector>

namespace plastron::config {

struct NamedValue {
  std::string name;
  toml::value value;
};

/// `vectors`: the names that have components. One value for a whole vector is reported. `other`: a component's other
/// names besides x, y, z in the message, for example "n" for u.n.
std::vector<NamedValue> named_values(Reading& reading, const toml::value& table,
                                     const std::vector<std::string>& vectors, const std::string& other = "");

}  // namespace plastron::config
