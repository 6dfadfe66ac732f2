// The JSON Schema (draft 7) of the case file, for editors that complete and check TOML while one writes it. What it cannot say (names that
// must exist, expressions that must be valid, radii that must fit) `plastron check` says.
#pragma once
#include <nlohmann/json.hpp>

namespace plastron::config {

/// Made from sections().
nlohmann::ordered_json case_schema();

}  // namespace plastron::config
