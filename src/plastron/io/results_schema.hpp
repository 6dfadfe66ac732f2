// The JSON Schema (draft 7) of results.json, for who reads it with a program. Later versions may add entries: these are not forbidden.
#pragma once
#include <plastron/io/quantities.hpp>

namespace plastron::io {

/// Made from parts().
Json results_schema();

}  // namespace plastron::io
