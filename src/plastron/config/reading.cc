#include <plastron/config/nearest.hpp>
#include <plastron/config/reading.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::config {

namespace {

// toml11 turns a number that is too large into the largest one.
constexpr double largest = 1e300;
constexpr std::size_t most_digits = 18;

std::string found(const toml::value& value) {
  switch (value.type()) {
    case toml::value_t::boolean:
      return "true or false";
    case toml::value_t::integer:
    case toml::value_t::floating:
      return "a number";
    case toml::value_t::string:
      return "text";
    case toml::value_t::array:
      return "a list";
    case toml::value_t::table:
      return "a table";
    default:
      return "a date or time";
  }
}

// The value if it may be used; NaN is silent where it comes from a constant already reported.
std::optional<double> finite(Reading& reading, const Item& item, double value) {
  if (std::abs(value) < largest) return value;
  if (reading.constants_complete || !item.value.is_string())
    reading.report(reading.source.value(item.value),
                   fmt::format("{} is {}, which is no finite number", item.name, value));
  return {};
}

std::optional<double> plain_number(Reading& reading, const Item& item) {
  if (item.value.is_floating()) return finite(reading, item, item.value.as_floating());
  const Place place = reading.source.value(item.value);
  if (place.length <= most_digits) return static_cast<double>(item.value.as_integer());
  reading.report(place, fmt::format("{} is too large for a whole number", item.name), "", "write it as 1e20");
  return {};
}

std::optional<geometry::Expression> expression(Reading& reading, const Item& item, bool parameters_allowed) {
  if (!check_expression_text(reading, item)) return {};
  const std::string& text = item.value.as_string().str;
  try {
    geometry::Expression parsed(text, reading.constants);
    if (!parsed.is_constant()) {
      if (!parameters_allowed) [[maybe_unused]]
        const double fails = geometry::evaluate_constant(text, reading.constants);
      return parsed;
    }
    if (finite(reading, item, parsed(0, 0))) return parsed;
  } catch (const geometry::ExpressionError& error) {
    report_expression(reading, item, error, parameters_allowed);
  }
  return {};
}

bool in_range(Reading& reading, const Item& item, double value) {
  if (item.range.contains(value)) return true;
  report_range(reading, item, value);
  return false;
}

std::string identifier_at(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
  return begin < text.size() ? text.substr(begin, end - begin) : "";
}

}  // namespace

const std::vector<std::string>& expression_names() {
  static const std::vector<std::string> all{"x",    "y",    "pi",    "sin",  "cos",  "tan",  "asin",
                                            "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp",
                                            "log",  "sqrt", "abs",   "min",  "max",  "sign"};
  return all;
}

std::vector<std::pair<std::string, toml::value>> entries(const Reading& reading, const toml::value& table) {
  std::vector<std::pair<std::string, toml::value>> all(table.as_table().begin(), table.as_table().end());
  std::ranges::sort(all, {}, [&](const auto& entry) {
    return std::pair(reading.source.key(entry.first, entry.second).offset, entry.first);
  });
  return all;
}

void report_kind(Reading& reading, const Item& item, Kind expected) {
  reading.report(reading.source.value(item.value),
                 fmt::format("{} must be {}, found {}", item.name, description(expected), found(item.value)));
}

void report_range(Reading& reading, const Item& item, double value) {
  reading.report(reading.source.value(item.value), fmt::format("{} is {}, out of range", item.name, value),
                 item.range.text(item.name.starts_with("entry ") ? "entry" : item.name));
}

void report_expression(Reading& reading, const Item& item, const geometry::ExpressionError& error,
                       bool parameters_allowed) {
  const std::string& text = item.value.as_string().str;
  const std::string word = identifier_at(text, error.position);
  const std::string message = error.what();
  const Place place = reading.source.inside(item.value, error.position);
  if (message.find("unknown name") == std::string::npos || word.empty()) {
    reading.report(place, fmt::format("{}: {}", item.name, message));
    return;
  }
  std::vector<std::string> known;
  for (const std::string& name : expression_names())
    if (parameters_allowed || (name != "x" && name != "y")) known.push_back(name);
  for (const auto& [name, value] : reading.constants) known.push_back(name);
  std::string advice = did_you_mean(word, known);
  if (word == "x" || word == "y") advice = "x and y are not known here: the value must be constant";
  if (std::ranges::count(reading.later_constants, word) > 0)
    advice = fmt::format("\"{}\" is defined below: constants use those above them", word);
  reading.report(place, fmt::format("unknown name \"{}\" in the expression of {}", word, item.name), joined(known),
                 advice);
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

std::optional<bool> read_boolean(Reading& reading, const Item& item) {
  if (item.value.is_boolean()) return item.value.as_boolean();
  report_kind(reading, item, Kind::boolean);
  return {};
}

std::optional<std::string> read_text(Reading& reading, const Item& item) {
  if (item.value.is_string()) return item.value.as_string().str;
  report_kind(reading, item, Kind::text);
  return {};
}

std::optional<double> read_number(Reading& reading, const Item& item) {
  std::optional<double> value;
  if (item.value.is_string()) {
    const auto constant = expression(reading, item, false);
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
  reading.report(reading.source.value(item.value), fmt::format("{} is {}, not a whole number", item.name, *value),
                 item.range.text(item.name));
  return {};
}

std::optional<geometry::Expression> read_field(Reading& reading, const Item& item) {
  if (item.value.is_string()) {
    auto field = expression(reading, item, true);
    if (!field || (field->is_constant() && !in_range(reading, item, (*field)(0, 0)))) return {};
    return field;
  }
  if (!item.value.is_integer() && !item.value.is_floating()) {
    report_kind(reading, item, Kind::field);
    return {};
  }
  const auto value = plain_number(reading, item);
  if (!value || !in_range(reading, item, *value)) return {};
  return geometry::Expression(*value);
}

}  // namespace plastron::config
