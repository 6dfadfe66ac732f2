// What a case file may say: every key with its kind, unit, default, range and meaning. The reader takes its known keys,
// defaults and ranges from here, messages their lists of what is allowed, and the manual its reference chapter.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plastron::config {

enum class Kind {
  text,
  name,           ///< a text of few characters that the user chooses
  word,           ///< one of Key::words
  word_or_false,  ///< or false
  boolean,
  integer,
  number,         ///< a number or an expression of the constants
  numbers,        ///< a list of numbers
  point,          ///< two numbers
  vector,         ///< three numbers
  vectors,        ///< a list of vectors
  cell_counts,    ///< two integers
  names,          ///< a list of texts; one of Key::words each, if there are any
  name_or_names,  ///< a name, or a list of some
  points,         ///< a list of points
  field,          ///< a number or an expression of x, y and the constants
  field_vector,   ///< three fields
  space_formula,  ///< an expression of X, Y, Z with two derivatives
  formulas,       ///< three fields with two derivatives, or a table of such by region
  table,
  tables,     ///< a repeated section
  free_table  ///< a table whose keys are names of the user's choice
};

/// An interval, its ends included unless open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  /// low < value <= high.
  static Range above_to(double low, double high) { return {.low = low, .high = high, .low_open = true}; }
  bool contains(double value) const;
  /// "0 < name <= 2", or "" without limits.
  std::string text(const std::string& name) const;
};

struct Word {
  std::string name;
};

struct Key {
  std::string name{};
  Kind kind = Kind::number;
  std::string unit{};
  std::string fallback{};  ///< the default, in TOML; empty: none
  bool required = false;
  Range range{};
  std::vector<Word> words{};
  std::string meaning{};
  std::string example{};            ///< a value in TOML, shown when a required key is missing
  std::optional<Kind> shorthand{};  ///< what may stand there in place of a table
};

struct Section {
  std::string path;    ///< "" for the file, "shell", "geometry.domain.disk", ...
  std::string header;  ///< as messages call it
  std::string meaning;
  std::vector<Key> keys;
  std::vector<std::string> exactly_one{};  ///< keys of which one is given, and no other
  std::string other_keys{};                ///< what other keys are, each a number; empty: there are none
};

const std::vector<Section>& sections();
const Section& section(const std::string& path);

std::vector<std::string> names(const std::vector<Key>& keys);
/// The names of the words this version can do.
std::vector<std::string> word_names(const std::vector<Word>& words);
/// "a number or an expression of the constants", for messages and the manual.
std::string description(Kind kind);
/// "a, b, c".
std::string joined(const std::vector<std::string>& words);

}  // namespace plastron::config
