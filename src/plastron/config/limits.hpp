// What the program cannot compute, for messages about words of other programs and for `plastron explain`. docs/limits.md has
// the same rows: a test compares both.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace plastron::config {

struct Limit {
  std::string name;
  std::vector<std::string>
      aliases;  ///< other words, "-" for "_"; "load.point" is the key of a section, ".force" a section
  std::string left_out, shows, advice;
};

const std::vector<Limit>& limits();

/// Returns the limit that a word, or the key of a section, belongs to; null if there is none.
const Limit* limit_of(std::string_view section, std::string_view word);

}  // namespace plastron::config
