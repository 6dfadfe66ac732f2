// Converts declarations to words.
#include <fmt/format.h>
#include <plastron/config/schema.hpp>

#include <cmath>

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

std::vector<std::string> names(const std::vector<Key>& keys) {
  std::vector<std::string> all;
  all.reserve(keys.size());
  for (const Key& key : keys) all.push_back(key.name);
  return all;
}

std::vector<std::string> word_names(const std::vector<Word>& words) {
  std::vector<std::string> all;
  all.reserve(words.size());
  for (const Word& word : words) all.push_back(word.name);
  return all;
}

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t most = 40;
  if (words.size() <= most) return fmt::format("{}", fmt::join(words, ", "));
  return fmt::format("{} and {} more", fmt::join(words.begin(), words.begin() + most, ", "), words.size() - most);
}

std::string description(Kind kind) {
  switch (kind) {
    case Kind::text:
      return "text in quotes";
    case Kind::name:
      return "a name in quotes";
    case Kind::word:
      return "a word in quotes";
    case Kind::word_or_false:
      return "a word in quotes or false";
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "a whole number";
    case Kind::number:
      return "a number or an expression of the constants";
    case Kind::numbers:
      return "a list of numbers";
    case Kind::point:
      return "a list of two numbers";
    case Kind::vector:
      return "a list of three numbers";
    case Kind::vectors:
      return "a list of vectors [x, y, z]";
    case Kind::cell_counts:
      return "a list of two whole numbers";
    case Kind::names:
      return "a list of texts";
    case Kind::name_or_names:
      return "a name in quotes or a list of names";
    case Kind::points:
      return "a list of points [x, y]";
    case Kind::field:
      return "a number or an expression of x, y and the constants";
    case Kind::field_vector:
      return "a list of three numbers or expressions of x, y and the constants";
    case Kind::space_formula:
      return "an expression of X, Y, Z and the constants";
    case Kind::formulas:
      return "a list of three expressions of x, y and the constants";
    case Kind::table:
    case Kind::free_table:
      return "a table";
    case Kind::tables:
      return "a list of tables";
  }
  return "";
}

}  // namespace plastron::config
