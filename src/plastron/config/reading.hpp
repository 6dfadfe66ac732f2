// The common data of all readers of one case file, and the readers of single values. A reader reports mistakes and
// returns nothing. Then reading continues, so that all mistakes are found together.
#pragma once
#include <fmt/format.h>
#include <plastron/config/schema.hpp>
#include <plastron/config/source.hpp>
#include <plastron/domain/domain.hpp>
#include <plastron/geometry/space_function.hpp>
#include <plastron/shell/material.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace plastron::config {

/// A material of [[material]].
struct NamedMaterial {
  shell::Material material{};
  std::optional<shell::Orthotropic> layer{};  ///< the constants of a layer of this material; empty for a laminate
};

struct Reading {
  const Source& source;
  std::filesystem::path folder{};                                      ///< folder of the files that the case names
  std::vector<std::pair<std::string, std::filesystem::path>> files{};  ///< files that the case names, with their paths
  std::optional<domain::Domain> domain{};                              ///< empty: it is wrong, or not read yet
  geometry::Constants constants{};
  std::map<std::string, std::optional<NamedMaterial>> materials{};  ///< by name; empty: the material is wrong
  std::vector<std::string> later_constants{};                       ///< constants below the one being read
  nlohmann::json part = nlohmann::json::object();                   ///< of a CAD file: faces, regions, boundaries
  bool constants_complete =
      true;  ///< false: some constant is wrong and is NaN; mistakes that follow from it are not reported
  std::vector<Mistake> mistakes{};
  bool more_mistakes = false;  ///< there were more than most_mistakes, and the rest was dropped

  /// Returns the names of the domain's boundaries; empty if they are not known. The same holds for `regions`.
  std::vector<std::string> boundaries() const {
    return domain ? domain::boundary_names(*domain) : std::vector<std::string>{};
  }
  std::vector<std::string> regions() const {
    return domain ? domain::region_names(*domain) : std::vector<std::string>{};
  }
  bool has_mesh_in_space() const {
    const auto* file = domain ? std::get_if<domain::MeshFile>(&*domain) : nullptr;
    return file && file->in_space;
  }
  /// Notes a file that the case names; returns its path.
  std::filesystem::path file(const std::string& name) { return files.emplace_back(name, folder / name).second; }
  void report(Place place, std::string what, std::string allowed = "", std::string advice = "") {
    Mistake mistake = source.mistake(place, std::move(what), std::move(allowed), std::move(advice));
    const auto is_same = [&](const Mistake& other) {
      return other.line == mistake.line && other.column == mistake.column && other.what == mistake.what;
    };
    if (std::ranges::any_of(mistakes, is_same)) return;  // checks read tables once more
    more_mistakes = mistakes.size() >= most_mistakes;
    if (!more_mistakes) mistakes.push_back(std::move(mistake));
  }
  void report(const toml::value& value, std::string what, std::string allowed = "", std::string advice = "") {
    report(source.value(value), std::move(what), std::move(allowed), std::move(advice));
  }
};

/// A value to be read, and its name in messages.
struct Item {
  const toml::value& value;
  std::string name;
  Range range{};
  std::string unit{};
};

/// Returns the value of a component of a displacement or of a rotation, "u.x" or "r.x". A rotation is at most a whole turn.
Item component_item(const toml::value& value, const std::string& name);

std::optional<bool> read_boolean(Reading& reading, const Item& item);
std::optional<std::string> read_text(Reading& reading, const Item& item, Kind expected = Kind::text);
/// Reads a name of the user's choice: not empty, not long, without control characters.
std::optional<std::string> read_name(Reading& reading, const Item& item);
/// Reads a number or an expression of the constants, finite and in the item's range.
std::optional<double> read_number(Reading& reading, const Item& item);
std::optional<int> read_integer(Reading& reading, const Item& item);
/// Reads a number or an expression of x, y (not on a mesh in space), X, Y, Z. A constant is finite and in the item's range.
std::optional<geometry::Expression> read_field(Reading& reading, const Item& item);
/// Reads one of the three formulas of a chart, a number or an expression of x and y.
std::optional<geometry::Expression> read_chart_formula(Reading& reading, const Item& item);

/// Reads an expression of X, Y, Z and the constants with two derivatives.
std::shared_ptr<const geometry::SpaceFunction> read_space_function(Reading& reading, const Item& item);

/// Reports an expression without two derivatives.
void report_not_differentiable(Reading& reading, const Item& item, const geometry::NotDifferentiable& error);
void report_kind(Reading& reading, const Item& item, Kind expected);
void report_range(Reading& reading, const Item& item, double value);
/// Marks the wrong character of the string.
void report_expression(Reading& reading, const Item& item, const geometry::ExpressionError& error,
                       const std::vector<std::string>& variables);
/// Refuses text that the expressions' library would accept, but the manual does not describe. Returns whether the text is
/// right.
bool check_expression_text(Reading& reading, const Item& item);

/// Returns the names that expressions know already: x, y, pi and the functions.
const std::vector<std::string>& expression_names();

/// Returns the entries of a table in the order of the file.
std::vector<std::pair<std::string, toml::value>> entries(const Reading& reading, const toml::value& table);

/// Returns the entries of a table "values" by component: { u.z = 1 }, { "u.z" = 1 } and { u = [0, 0, 1] } are alike.
/// `vectors`: the names that have components. One value for a whole vector is reported. `other`: a component's other
/// names besides x, y, z in the message, for example "n" for u.n. A component with two values is reported.
std::vector<std::pair<std::string, toml::value>> named_values(Reading& reading, const toml::value& table,
                                                              const std::vector<std::string>& vectors,
                                                              const std::string& other = "");

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
    reading.report(item.value, what, description(kind));
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

/// Reads a list of `size` numbers, two or three.
template <int size>
std::optional<Eigen::Matrix<double, size, 1>> read_vector(Reading& reading, const Item& item) {
  const auto list = read_list(reading, item, size == 2 ? Kind::point : Kind::vector, size, read_number);
  if (!list) return {};
  return Eigen::Matrix<double, size, 1>(list->data());
}

/// A point of the shell: x, y in the domain, or X, Y, Z in space.
using ShellPlace = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
inline bool is_in_space(const ShellPlace& place) { return place.size() == 3; }
/// Reads a place; on a mesh in space only X, Y, Z.
std::optional<ShellPlace> read_place(Reading& reading, const Item& item);

}  // namespace plastron::config
