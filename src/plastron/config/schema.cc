#include <fmt/format.h>
#include <plastron/config/schema.hpp>

#include <cmath>
#include <map>

namespace plastron::config {

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text(const std::string& name) const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  const char *below = low_open ? "<" : "<=", *above = high_open ? "<" : "<=";
  if (has_low && has_high) return fmt::format("{} {} {} {} {}", low, below, name, above, high);
  if (has_low) return fmt::format("{} {} {}", name, low_open ? ">" : ">=", low);
  return has_high ? fmt::format("{} {} {}", name, above, high) : "";
}

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t most = 40;
  if (words.size() <= most) return fmt::format("{}", fmt::join(words, ", "));
  return fmt::format("{} and {} more", fmt::join(words.begin(), words.begin() + most, ", "), words.size() - most);
}

std::string description(Kind kind) {
  static const std::map<Kind, std::string> descriptions{
      {Kind::text, "text in quotes"},
      {Kind::name, "a name in quotes"},
      {Kind::word, "a word in quotes"},
      {Kind::word_or_false, "a word in quotes or false"},
      {Kind::boolean, "true or false"},
      {Kind::integer, "a whole number"},
      {Kind::integer_or_word, "a whole number or a word in quotes"},
      {Kind::number, "a number or an expression of the constants"},
      {Kind::numbers, "a list of numbers"},
      {Kind::point, "a list of two numbers"},
      {Kind::place, "a list of two numbers [x, y] or three [X, Y, Z]"},
      {Kind::places, "a list of points [x, y] or [X, Y, Z]"},
      {Kind::vector, "a list of three numbers"},
      {Kind::vectors, "a list of vectors [x, y, z]"},
      {Kind::cell_counts, "a list of two whole numbers"},
      {Kind::names, "a list of texts"},
      {Kind::name_or_names, "a name in quotes or a list of names"},
      {Kind::points, "a list of points [x, y]"},
      {Kind::field, "a number or an expression of x, y, X, Y, Z and the constants"},
      {Kind::field_vector, "a list of three numbers or expressions of x, y, X, Y, Z and the constants"},
      {Kind::space_formula, "an expression of X, Y, Z and the constants"},
      {Kind::formulas, "a list of three expressions of x, y and the constants"},
      {Kind::table, "a table"},
      {Kind::free_table, "a table"},
      {Kind::tables, "a list of tables"}};
  return descriptions.at(kind);
}

std::string allowed_values(const Key& key) {
  if (key.kind == Kind::integer_or_word) return key.range.text(key.name) + ", or " + joined(key.words);
  return key.words.empty() ? key.range.text(key.name) : joined(key.words);
}

}  // namespace plastron::config
