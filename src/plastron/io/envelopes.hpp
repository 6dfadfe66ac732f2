// Envelopes of load cases: the least and the largest value of each number, and the case that has it.
#pragma once
#include <plastron/io/quantities.hpp>

namespace plastron::io {

/// Returns one record for each of `envelopes`, the effective settings of [[envelope]]: its name, and under "numbers" for each path inside
/// a record of `history` the least and the largest value with their cases.
Json envelopes_json(const Json& history, const Json& envelopes);

}  // namespace plastron::io
