// The JSON Schema (draft 7) of the case file, for editors that complete and check TOML during writing. Conditions that
// it cannot express (names that must exist, expressions that must be valid, radii that must fit) are checked by
// `plastron check`.
#pragma once
#include <nlohmann/json.hpp>

namespace plastron::config {

/// Makes the schema from sections().
nlohmann::ordered_json case_schema();

}  // namespace plastron::config
