// The declarations of the case file: every key with its kind, unit, default, range and meaning. They give the reader
// its known keys, defaults and ranges, messages their lists of allowed values, and the manual its reference chapter.
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
  word_or_false,  ///< one of Key::words, or false
  boolean,
  integer,
  number,         ///< a number or an expression of the constants
  numbers,        ///< a list of numbers
  point,          ///< two numbers
  vector,         ///< three numbers
  vectors,        ///< a list of vectors
  cell_counts,    ///< two integers
  names,          ///< a list of texts; each is one of Key::words, if there are any
  name_or_names,  ///< a name, or a list of some
  points,         ///< a list of points
  field,          ///< a number or an expression of x, y and the constants
  field_vector,   ///< three fields
  space_formula,  ///< an expression of X, Y, Z with two derivatives
  formulas,       ///< three fields with two derivatives, or a table of them by region
  table,
  tables,     ///< a repeated section
  free_table  ///< a table whose keys are names of the user's choice
};

/// An interval, including its ends unless open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  /// Returns low < value <= high.
  static Range above_to(double low, double high) { return {.low = low, .high = high, .low_open = true}; }
  bool contains(double value) const;
  /// Returns "0 < name <= 2", or "" without limits.
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
  std::optional<Kind> shorthand{};  ///< kind of value allowed in place of a table
};

struct Section {
  std::string path;    ///< "" for the file, "shell", "geometry.domain.disk", ...
  std::string header;  ///< name in messages
  std::string meaning;
  std::vector<Key> keys;
  std::vector<std::string> exactly_one{};  ///< exactly one of these keys is given
  std::string other_keys{};                ///< description of other keys, each a number; empty: no other keys
};

const std::vector<Section>& sections();
const Section& section(const std::string& path);

std::vector<std::string> names(const std::vector<Key>& keys);
/// Returns the names of the words that this version supports.
std::vector<std::string> word_names(const std::vector<Word>& words);
/// Returns a description for messages and the manual: "a number or an expression of the constants".
std::string description(Kind kind);
/// Returns the words as a list: "a, b, c".
std::string joined(const std::vector<std::string>& words);

}  // namespace plastron::config
