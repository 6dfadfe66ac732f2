// The parts of results.json and what stands in each: the tables of quantities and fields, walked through without a result.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// A row of a table, and its words about a value.
struct Entry {
  std::string_view path, unit, meaning;
  Form form;
  bool can_be_absent = false;  ///< null where it has no meaning
};

/// A record of results.json. `place` ends in '/' or is empty; "*" stands for all of a list, after "probes" for their names:
/// "obstacles/*/zones/*/".
struct Part {
  std::string place;
  std::string_view meaning;
  std::vector<Entry> entries;
};

/// In the order of their units in results.json.
const std::vector<Part>& parts();

/// "obstacles[].zones[].area", "probes.NAME.u": a place and the path in it as the manual has them.
std::string dotted(std::string_view place, std::string_view path);

}  // namespace plastron::io
