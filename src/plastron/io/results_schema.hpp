// The parts of results.json and their contents: the tables of quantities and fields, listed without a result. The JSON
// Schema (draft 7) is made from them, for programs that read results.json.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// A row of a table, with its description of a value.
struct Entry {
  std::string_view path, unit, meaning;
  Form form;
  bool can_be_absent = false;  ///< null if it has no meaning
};

/// A record of results.json. `place` ends in '/' or is empty; "*" is every entry of a list, and after "probes" every
/// name: "obstacles/*/zones/*/".
struct Part {
  std::string place;
  std::string_view meaning;
  std::vector<Entry> entries;
};

/// Returns the parts in the order of their units in results.json.
const std::vector<Part>& parts();

/// Returns "obstacles[].zones[].area", "probes.NAME.u": a place and the path in it in the form of the manual.
std::string dotted(std::string_view place, std::string_view path);

/// Makes the schema from parts(). Later versions may add entries: these are allowed.
Json results_schema();

}  // namespace plastron::io
