// What the program cannot compute, for messages about words of other programs and for `plastron explain`. docs/limits.md has
// the same rows: a test compares both.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace plastron::config {

struct Limit {
  std::string name;
  /// Other words, with "-" in place of "_". "load.point" is a key of a section, ".force" is a section.
  std::vector<std::string> aliases;
  std::string left_out, shows, advice;
};

const std::vector<Limit>& limits();

/// Returns the limit that a word, or the key of a section, belongs to; null if there is none.
const Limit* limit_of(std::string_view section, std::string_view word);

}  // namespace plastron::config
