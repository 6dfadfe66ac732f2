#include <plastron/config/nearest.hpp>
#include <plastron/config/printable.hpp>
#include <plastron/config/reading.hpp>
#include <plastron/geometry/quotation.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

namespace plastron::config {

namespace {

// Products of six such numbers, E e^3 |u|^2 with an area, are still finite. No shell reaches these limits in any units.
constexpr double largest = 1e50, smallest = 1e-50;
constexpr std::size_t most_digits = 18;

std::string found(const toml::value& value) {
  if (value.is_boolean()) return "true or false";
  if (value.is_integer() || value.is_floating()) return "a number";
  if (value.is_string()) return "text";
  if (value.is_array()) return "a list";
  return value.is_table() ? "a table" : "a date or time";
}

// Returns the value if it can be used. A NaN from a constant already reported is not reported again.
std::optional<double> finite(Reading& reading, const Item& item, double value) {
  if (std::abs(value) < largest) return value;
  if (!reading.constants_complete && item.value.is_string()) return {};
  // toml11 converts a number that is too large to the largest one.
  const bool is_finite = std::abs(value) < std::numeric_limits<double>::max();
  reading.report(item.value,
                 fmt::format("{} is {:g}, which is {}", item.name, value,
                             is_finite ? "too large to compute with" : "no finite number"),
                 is_finite ? fmt::format("|{}| < {:g}", item.name, largest) : "");
  return {};
}

std::optional<double> plain_number(Reading& reading, const Item& item) {
  if (item.value.is_floating()) return finite(reading, item, item.value.as_floating());
  const Place place = reading.source.value(item.value);
  if (place.length <= most_digits) return static_cast<double>(item.value.as_integer());
  reading.report(place, fmt::format("{} is too large for a whole number", item.name), "", "write it as 1e20");
  return {};
}

const std::vector<std::string> plane_variables{"x", "y"}, space_variables{"X", "Y", "Z"},
    all_variables{"x", "y", "X", "Y", "Z"};

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)); }

/// Returns the place where the text calls a function that the manual does not list; the library behind expressions may
/// know it.
std::optional<std::size_t> unlisted_function(const std::string& text) {
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    end = begin + 1;
    if (!in_name(text[begin]) && text[begin] != '.') continue;
    while (end < text.size() && (in_name(text[end]) || text[end] == '.')) ++end;
    const std::size_t next = std::min(text.find_first_not_of(" \t\r\n", end), text.size());
    const bool is_call = begins_name(text[begin]) && next < text.size() && text[next] == '(';
    if (is_call && std::ranges::count(expression_names(), text.substr(begin, end - begin)) == 0) return begin;
  }
  return {};
}

bool in_range(Reading& reading, const Item& item, double value) {
  const bool is_tiny = item.range.low == 0 && item.range.low_open && value > 0 && value < smallest;
  if (is_tiny)
    reading.report(item.value, fmt::format("{} is {:g}, which is too small to compute with", item.name, value),
                   fmt::format("{} >= {:g}", item.name, smallest));
  if (item.range.contains(value)) return !is_tiny;
  report_range(reading, item, value);
  return false;
}

/// Returns whether the expression has none of the variables that are not allowed, and reports them.
bool uses_only(Reading& reading, const Item& item, const geometry::Expression& parsed,
               const std::vector<std::string>& variables) {
  const bool has_plane = std::ranges::count(variables, "x") > 0, has_space = std::ranges::count(variables, "X") > 0;
  if (parsed.uses_space() && !has_space) {
    reading.report(item.value, fmt::format("{} uses X, Y or Z, the values of the chart itself", item.name),
                   "x, y and the constants", "a chart is a function of x and y");
    return false;
  }
  if (parsed.uses_parameters() && !has_plane) {
    reading.report(item.value, fmt::format("{} uses x or y, which a mesh in space does not have", item.name),
                   "X, Y, Z and the constants", "X, Y, Z is the place on the mid-surface before the shell deforms");
    return false;
  }
  return true;
}

/// Reads text. Without variables, the expression must be constant.
std::optional<geometry::Expression> expression(Reading& reading, const Item& item,
                                               const std::vector<std::string>& variables) {
  if (!check_expression_text(reading, item)) return {};
  const std::string& text = item.value.as_string().str;
  try {
    if (const auto at = unlisted_function(text)) throw geometry::ExpressionError("unknown name", *at);
    geometry::Expression parsed(text, reading.constants);
    if (parsed.is_constant()) return finite(reading, item, parsed({})) ? std::optional(parsed) : std::nullopt;
    if (variables.empty()) [[maybe_unused]]
      const double fails = geometry::evaluate_constant(text, reading.constants);
    if (uses_only(reading, item, parsed, variables)) return parsed;
  } catch (const geometry::ExpressionError& error) {
    report_expression(reading, item, error, variables);
  }
  return {};
}

/// Reads a number or an expression of the variables. A constant is finite and in the item's range.
std::optional<geometry::Expression> read_function(Reading& reading, const Item& item,
                                                  const std::vector<std::string>& variables) {
  if (item.value.is_string()) {
    auto read = expression(reading, item, variables);
    if (!read || (read->is_constant() && !in_range(reading, item, (*read)(0, 0)))) return {};
    return read;
  }
  if (!item.value.is_integer() && !item.value.is_floating()) {
    report_kind(reading, item, Kind::field);
    return {};
  }
  const auto value = plain_number(reading, item);
  if (!value || !in_range(reading, item, *value)) return {};
  return geometry::Expression(*value);
}

std::string identifier_at(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
  return begin < text.size() ? text.substr(begin, end - begin) : "";
}

/// Whether a value names no component: one number, or a list that does not have three values.
bool names_no_component(Reading& reading, const std::string& name, const toml::value& value, const std::string& other) {
  if (value.is_table() || (value.is_array() && value.as_array().size() == 3)) return false;
  const std::string also = other.empty() ? "" : fmt::format(", {}.{} = ...", name, other);
  reading.report(value,
                 value.is_array() ? fmt::format("{} has {} entries, but must have 3", name, value.as_array().size())
                                  : fmt::format("{} is a vector, and one value does not say which component", name),
                 fmt::format("{0}.x = ...{1} and their like, or {0} = [three values]", name, also),
                 fmt::format("for example values = {{ {0}.z = -0.02 }} or values = {{ {0} = [0, 0, -0.02] }}", name));
  return true;
}

}  // namespace

const std::vector<std::string>& expression_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names{"x", "y", "X", "Y", "Z", "pi"};
    for (const auto* functions : {&geometry::smooth_functions(), &geometry::other_functions()})
      names.insert(names.end(), functions->begin(), functions->end());
    return names;
  }();
  return all;
}

std::vector<std::pair<std::string, toml::value>> entries(const Reading& reading, const toml::value& table) {
  std::map<std::pair<std::size_t, std::string>, const toml::value*> in_order;
  for (const auto& [name, value] : table.as_table())
    in_order.emplace(std::pair(reading.source.key(name, value).offset, name), &value);
  std::vector<std::pair<std::string, toml::value>> all;
  all.reserve(in_order.size());
  for (const auto& [place, value] : in_order) all.emplace_back(place.second, *value);
  return all;
}

std::vector<std::pair<std::string, toml::value>> named_values(Reading& reading, const toml::value& table,
                                                              const std::vector<std::string>& vectors,
                                                              const std::string& other) {
  std::vector<std::pair<std::string, toml::value>> all;
  const auto add = [&](const std::string& name, const toml::value& value) {
    if (std::ranges::find(all, name, &std::pair<std::string, toml::value>::first) == all.end())
      all.emplace_back(name, value);
    else
      reading.report(value, fmt::format("values gives {} twice", geometry::shortened(name)));
  };
  for (const auto& [name, value] : entries(reading, table)) {
    const bool is_vector = std::ranges::find(vectors, name) != vectors.end();
    if (is_vector && names_no_component(reading, name, value, other)) continue;
    if (value.is_table()) {
      for (const auto& [direction, inner] : entries(reading, value)) add(fmt::format("{}.{}", name, direction), inner);
    } else if (value.is_array() && is_vector) {
      for (std::size_t i = 0; i < 3; ++i) add(fmt::format("{}.{}", name, "xyz"[i]), value.as_array()[i]);
    } else {
      add(name, value);
    }
  }
  return all;
}

void report_not_differentiable(Reading& reading, const Item& item, const geometry::NotDifferentiable& error) {
  reading.report(item.value, fmt::format("{} cannot be differentiated twice: {}", item.name, error.reason),
                 fmt::format("+ - * / ^ and {}", fmt::join(geometry::smooth_functions(), " ")));
}

std::shared_ptr<const geometry::SpaceFunction> read_space_function(Reading& reading, const Item& item) {
  if (item.value.is_integer() || item.value.is_floating()) {
    const auto value = plain_number(reading, item);
    return value
               ? std::make_shared<const geometry::SpaceFunction>(fmt::format("{:.17g}", *value), geometry::Constants{})
               : nullptr;
  }
  if (!item.value.is_string()) {
    report_kind(reading, item, Kind::space_formula);
    return {};
  }
  if (!check_expression_text(reading, item) || !reading.constants_complete) return {};
  const std::string& text = item.value.as_string().str;
  try {
    if (const auto at = unlisted_function(text)) throw geometry::ExpressionError("unknown name", *at);
    return std::make_shared<const geometry::SpaceFunction>(text, reading.constants);
  } catch (const geometry::NotDifferentiable& error) {
    report_not_differentiable(reading, item, error);
  } catch (const geometry::ExpressionError& error) {
    report_expression(reading, item, error, space_variables);
  }
  return {};
}

std::optional<ShellPlace> read_place(Reading& reading, const Item& item) {
  const bool is_point = item.value.is_array() && item.value.as_array().size() == 2;
  if (is_point && reading.has_mesh_in_space()) {
    reading.report(item.value, fmt::format("{} has two numbers, but a mesh in space has no x and y", item.name),
                   "three numbers [X, Y, Z]", "the nearest point of the shell is taken, and its distance is reported");
    return {};
  }
  if (is_point) {
    const auto point = read_vector<2>(reading, item);
    return point ? std::optional(ShellPlace(*point)) : std::nullopt;
  }
  if (item.value.is_array() && item.value.as_array().size() == 3) {
    const auto place = read_vector<3>(reading, item);
    return place ? std::optional(ShellPlace(*place)) : std::nullopt;
  }
  if (item.value.is_array())
    reading.report(item.value,
                   fmt::format("{} has {} entries, but must have 2 or 3", item.name, item.value.as_array().size()),
                   description(Kind::place));
  else
    report_kind(reading, item, Kind::place);
  return {};
}

void report_kind(Reading& reading, const Item& item, Kind expected) {
  reading.report(item.value,
                 fmt::format("{} must be {}, found {}", item.name, description(expected), found(item.value)));
}

void report_range(Reading& reading, const Item& item, double value) {
  reading.report(item.value, fmt::format("{} is {}, out of range", item.name, value),
                 item.range.text(item.name.starts_with("entry ") ? "entry" : item.name),
                 item.unit == "rad" ? fmt::format("angles are in rad: {0:g} degrees are \"{0:g}*pi/180\"", value) : "");
}

void report_expression(Reading& reading, const Item& item, const geometry::ExpressionError& error,
                       const std::vector<std::string>& variables) {
  const std::string& text = item.value.as_string().str;
  const std::string word = identifier_at(text, error.position);
  const std::string message = error.what();
  const Place place = reading.source.inside(item.value, error.position);
  if (message.find("unknown name") == std::string::npos || word.empty()) {
    reading.report(place, fmt::format("{}: {}", item.name, message));
    return;
  }
  std::vector<std::string> known = variables;
  for (const std::string& name : expression_names())
    if (std::ranges::count(all_variables, name) == 0) known.push_back(name);
  for (const auto& [name, value] : reading.constants) known.push_back(name);
  std::string advice = did_you_mean(word, known);
  if (std::ranges::count(all_variables, word) > 0)
    advice = variables.empty() ? fmt::format("{} is not known here: the value must be constant", word)
                               : "the coordinates in space are X, Y, Z; x and y are the parameters of the mid-surface";
  const std::string_view before = std::string_view(text).substr(0, error.position);
  if (const std::size_t last = before.find_last_not_of(' ');
      advice.empty() && last != std::string_view::npos && std::isdigit(static_cast<unsigned char>(before[last])) != 0)
    advice = "numbers carry no unit: write the value in the units of the case, which [units] names";
  if (std::ranges::count(reading.later_constants, word) > 0)
    advice = fmt::format("\"{}\" is defined below: constants use those above them", word);
  reading.report(place,
                 fmt::format("unknown name \"{}\" in the expression of {}", geometry::shortened(word), item.name),
                 joined(known), advice);
}

bool check_expression_text(Reading& reading, const Item& item) {
  const std::string& text = item.value.as_string().str;
  const std::string other = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_. +-*/^()<>=!&|?:,\t\r\n";
  std::size_t at = text.find_first_not_of(other);
  for (std::size_t i = 0; i < text.size() && i < at; ++i) {
    if (text[i] != '=') continue;
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    const bool ends_comparison = i > 0 && (text[i - 1] == '<' || text[i - 1] == '>' || text[i - 1] == '!');
    if (doubled) ++i;
    if (!doubled && !ends_comparison) at = i;
  }
  if (at == std::string::npos) return true;
  reading.report(reading.source.inside(item.value, at),
                 fmt::format("the expression of {} has a character that is no part of expressions", item.name),
                 "+ - * / ^ ( ) == != < <= > >= && || and c ? a : b");
  return false;
}

Item component_item(const toml::value& value, const std::string& name) {
  if (name.starts_with("u.")) return {value, name};
  return {value, name, Range::between(-6.2832, 6.2832), "rad"};
}

std::optional<bool> read_boolean(Reading& reading, const Item& item) {
  if (item.value.is_boolean()) return item.value.as_boolean();
  report_kind(reading, item, Kind::boolean);
  return {};
}

std::optional<std::string> read_text(Reading& reading, const Item& item, Kind expected) {
  if (item.value.is_string()) return item.value.as_string().str;
  report_kind(reading, item, expected);
  return {};
}

std::optional<std::string> read_name(Reading& reading, const Item& item) {
  auto name = read_text(reading, item);
  if (!name) return {};
  const bool clean = !has_control_characters(*name);
  if (clean && name->size() <= longest_name) return name;
  reading.report(item.value,
                 clean ? fmt::format("{} is {} bytes long", item.name, name->size())
                       : fmt::format("{} has a control character", item.name),
                 fmt::format("at most {} bytes, no control characters", longest_name));
  return {};
}

std::optional<double> read_number(Reading& reading, const Item& item) {
  std::optional<double> value;
  if (item.value.is_string()) {
    const auto constant = expression(reading, item, {});
    if (constant) value = (*constant)(0, 0);
  } else if (item.value.is_integer() || item.value.is_floating()) {
    value = plain_number(reading, item);
  } else {
    report_kind(reading, item, Kind::number);
  }
  return value && in_range(reading, item, *value) ? value : std::nullopt;
}

std::optional<int> read_integer(Reading& reading, const Item& item) {
  const auto value = read_number(reading, item);
  if (!value) return {};
  if (*value == std::round(*value) && std::abs(*value) < 1e9) return static_cast<int>(*value);
  reading.report(item.value, fmt::format("{} is {}, not a whole number", item.name, *value),
                 item.range.text(item.name));
  return {};
}

std::optional<geometry::Expression> read_field(Reading& reading, const Item& item) {
  return read_function(reading, item, reading.has_mesh_in_space() ? space_variables : all_variables);
}

std::optional<geometry::Expression> read_chart_formula(Reading& reading, const Item& item) {
  return read_function(reading, item, plane_variables);
}

}  // namespace plastron::config
