// The declarations of the case file: every key with its kind, unit, default, range and meaning. They give the reader
// its known keys, defaults and ranges, messages their lists of allowed values, and the manual its reference chapter.
#pragma once
#include <any>
#include <functional>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plastron::config {

// Limits of a case file. Cases written by hand are smaller. Larger ones would take minutes to read, or exhaust memory
// or the stack.
inline constexpr std::size_t largest_file = 1 << 18;  ///< bytes
inline constexpr std::size_t deepest_nesting = 20;    ///< levels of lists, tables in braces and the parts of a key
inline constexpr std::size_t most_entries = 500;      ///< in a list or a table; also number of sections with one name
inline constexpr std::size_t most_mistakes = 50;      ///< reported for a file
inline constexpr std::size_t longest_name = 60;       ///< bytes of a name the user chooses
inline constexpr double most_cells = 1e6;             ///< cells of the coarsest mesh

enum class Kind {
  text,
  name,           ///< a text of few characters that the user chooses
  word,           ///< one of Key::words
  word_or_false,  ///< one of Key::words, or false
  boolean,
  integer,
  integer_or_word,  ///< a whole number, or one of Key::words
  number,           ///< a number or an expression of the constants
  numbers,          ///< a list of numbers
  point,            ///< two numbers
  place,            ///< two numbers, x and y, or three, X, Y and Z
  places,           ///< a list of places
  vector,           ///< three numbers
  vectors,          ///< a list of vectors
  cell_counts,      ///< two integers
  names,            ///< a list of texts; each is one of Key::words, if there are any
  name_or_names,    ///< a name, or a list of some
  points,           ///< a list of points
  field,            ///< a number or an expression of the variables and constants
  field_vector,     ///< three fields
  space_formula,    ///< an expression of X, Y, Z with two derivatives
  formulas,         ///< three fields with two derivatives, or a table of them by region
  table,
  tables,     ///< a repeated section
  free_table  ///< a table whose keys are names of the user's choice
};

/// An interval, including its ends unless open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  static Range between(double low, double high) { return {.low = low, .high = high}; }
  /// Returns 0 < value <= high.
  static Range positive(double high = std::numeric_limits<double>::infinity()) {
    return {.low = 0, .high = high, .low_open = true};
  }
  bool contains(double value) const;
  /// Returns "0 < name <= 2", or "" without limits.
  std::string text(const std::string& name) const;
};

class Table;

struct Key {
  std::string name{};
  Kind kind = Kind::number;
  std::string unit{};
  std::string fallback{};  ///< the default, in TOML; empty: none
  bool required = false;
  Range range{};
  std::vector<std::string> words{};
  std::string meaning{};
  std::string example{};            ///< a value in TOML, shown when a required key is missing
  std::optional<Kind> shorthand{};  ///< another kind of value that is allowed
  /// Reads the value into the object that a pointer of the right type points to (Table::fill). Returns false if the
  /// value is wrong or missing. Empty: the reader of the section reads the key by its name.
  std::function<bool(Table&, const Key&, const std::any& object)> put{};
};

struct Section {
  std::string path;    ///< "" for the file, "shell", "geometry.domain.disk", ...
  std::string header;  ///< name in messages
  std::string meaning;
  std::vector<Key> keys;
  std::vector<std::string> exactly_one{};  ///< exactly one of these keys is given
  std::string other_keys{};                ///< description of other keys, each a number; empty: no other keys
  std::vector<std::pair<std::string, std::string>> needs{};  ///< keys, and another key that each needs
};

/// Returns all sections in the order of the manual.
const std::vector<Section>& sections();
const Section& section(const std::string& path);

/// Returns a description for messages and the manual: "a number or an expression of the constants".
std::string description(Kind kind);
/// Returns the words as a list: "a, b, c".
std::string joined(const std::vector<std::string>& words);
/// Returns the allowed values of a key as messages and the manual show them: its range, its words, or both.
std::string allowed_values(const Key& key);

/// Returns the manual's reference of the case file as Markdown; docs/case-file.md is this text.
std::string describe_case_format();

/// Returns the JSON Schema (draft 7) of the case file, for editors that complete and check TOML during writing.
/// Conditions that it cannot express (names that must exist, expressions that must be valid, radii that must fit) are
/// checked by `plastron check`.
nlohmann::ordered_json case_schema();

}  // namespace plastron::config
