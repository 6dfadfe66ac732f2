// The common data of all readers of one case file, and the readers of single values. A reader reports mistakes and
// returns nothing. Then reading continues, so that all mistakes are found together.
#pragma once
#include <fmt/format.h>
#include <plastron/config/input_file.hpp>
#include <plastron/config/limits.hpp>
#include <plastron/config/schema.hpp>
#include <plastron/config/source.hpp>
#include <plastron/geometry/space_function.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace plastron::config {

struct Reading {
  const Source& source;
  std::filesystem::path folder{};  ///< folder of the files that the case names
  std::vector<InputFile> files{};  ///< files that the case names
  geometry::Constants constants{};
  std::vector<std::string> later_constants{};  ///< constants below the one being read
  bool constants_complete =
      true;  ///< false: some constant is wrong and is NaN; mistakes that follow from it are not reported
  std::vector<Mistake> mistakes{};
  bool more_mistakes = false;  ///< there were more than most_mistakes, and the rest was dropped

  /// Notes a file that the case names; returns its path.
  std::filesystem::path file(const std::string& name) {
    files.push_back({.name = name, .path = folder / name});
    return files.back().path;
  }
  void report(Place place, std::string what, std::string allowed = "", std::string advice = "") {
    more_mistakes = mistakes.size() >= most_mistakes;
    if (!more_mistakes)
      mistakes.push_back(source.mistake(place, std::move(what), std::move(allowed), std::move(advice)));
  }
};

/// A value to be read, and its name in messages.
struct Item {
  const toml::value& value;
  std::string name;
  Range range{};
};

std::optional<bool> read_boolean(Reading& reading, const Item& item);
std::optional<std::string> read_text(Reading& reading, const Item& item);
/// Reads a name of the user's choice: not empty, not long, without control characters.
std::optional<std::string> read_name(Reading& reading, const Item& item);
/// Reads a number or an expression of the constants, finite and in the item's range.
std::optional<double> read_number(Reading& reading, const Item& item);
std::optional<int> read_integer(Reading& reading, const Item& item);
/// Reads a number or an expression that may use x and y. A constant one is finite and in the item's range.
std::optional<geometry::Expression> read_field(Reading& reading, const Item& item);

/// Reads an expression of X, Y, Z and the constants with two derivatives.
std::shared_ptr<const geometry::SpaceFunction> read_space_function(Reading& reading, const Item& item);

void report_kind(Reading& reading, const Item& item, Kind expected);
void report_range(Reading& reading, const Item& item, double value);
/// Marks the wrong character of the string.
void report_expression(Reading& reading, const Item& item, const geometry::ExpressionError& error,
                       const std::vector<std::string>& variables);
/// Refuses text that the expressions' library would accept, but the manual does not describe. Returns true if there is
/// none.
bool check_expression_text(Reading& reading, const Item& item);

/// Returns the names that expressions know already: x, y, pi and the functions.
const std::vector<std::string>& expression_names();

/// Returns the entries of a table in the order of the file.
std::vector<std::pair<std::string, toml::value>> entries(const Reading& reading, const toml::value& table);

/// Reads a list of `count` values (any number for 0), each by `read`.
template <class Read>
auto read_list(Reading& reading, const Item& item, Kind kind, std::size_t count, Read read) {
  using Value = typename std::invoke_result_t<Read, Reading&, const Item&>::value_type;
  std::optional<std::vector<Value>> list;
  if (!item.value.is_array()) {
    report_kind(reading, item, kind);
    return list;
  }
  const auto& entries = item.value.as_array();
  if (count != 0 && entries.size() != count) {
    const std::string what = fmt::format("{} has {} entries, but must have {}", item.name, entries.size(), count);
    reading.report(reading.source.value(item.value), what, description(kind));
    return list;
  }
  std::vector<Value> values;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string name = fmt::format("entry {} of {}", i + 1, item.name);
    if (auto value = read(reading, Item{entries[i], name, item.range})) values.push_back(std::move(*value));
  }
  if (values.size() == entries.size()) list = std::move(values);
  return list;
}

}  // namespace plastron::config
