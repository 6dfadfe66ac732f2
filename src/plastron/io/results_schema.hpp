// The JSON Schema (draft 7) of results.json, for programs that read it. Later versions may add entries: these are
// allowed.
#pragma once
#include <plastron/io/quantities.hpp>

namespace plastron::io {

/// Makes the schema from parts().
Json results_schema();

}  // namespace plastron::io
