// A table of the case file with its declaration: only declared keys exist, absent ones have their default.
// Values that are read are also noted as effective settings.
#pragma once
#include <plastron/config/reading.hpp>
#include <plastron/energy/loads.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace plastron::config {

class Table {
 public:
  /// Reports the keys of `value` that are not declared.
  Table(Reading& reading, const Section& section, toml::value value);

  Reading& reading() const { return *reading_; }
  /// Returns true if the file gives the key.
  bool has(const std::string& name) const { return value_.as_table().count(name) > 0; }
  /// Returns the value in the file, or the default. A required key that is absent is reported.
  std::optional<toml::value> value(const std::string& name) const;
  /// Reports the key as missing unless the file gives it.
  void require(const std::string& name) const {
    if (!has(name)) report_missing(declared(name));
  }
  /// Reports a mistake in the value of a key of the file.
  void report(const std::string& name, std::string what, std::string allowed = "", std::string advice = "") const;
  /// Reports a key that the file gives, for example one too many.
  void report_key(const std::string& name, std::string what, std::string allowed = "", std::string advice = "") const;
  /// Reports a mistake in the table as a whole.
  void report_here(std::string what, std::string allowed = "", std::string advice = "") const;

  /// Reads the keys that are declared with a member of `Object`. Returns false if one is wrong or missing.
  template <class Object>
  bool fill(Object& object) {
    return fill_keys(&object);
  }

  std::optional<bool> boolean(const std::string& name);
  std::optional<int> integer(const std::string& name);
  std::optional<double> number(const std::string& name);
  std::optional<std::vector<double>> numbers(const std::string& name);
  std::optional<Eigen::Vector2d> point(const std::string& name);
  std::optional<Eigen::Vector3d> vector(const std::string& name);
  /// Returns the unit vector along the three numbers of a key; reports the zero vector.
  std::optional<Eigen::Vector3d> direction(const std::string& name);
  /// For members that may be empty. An angle is given in degrees and returned in radians.
  std::optional<std::optional<Eigen::Vector3d>> direction_or_none(const std::string& name) { return direction(name); }
  std::optional<std::optional<double>> number_or_none(const std::string& name) { return number(name); }
  std::optional<std::optional<double>> angle_or_none(const std::string& name);
  std::optional<ShellPlace> place(const std::string& name);
  std::optional<std::vector<ShellPlace>> places(const std::string& name);
  std::optional<std::vector<Eigen::Vector3d>> vectors(const std::string& name);
  std::optional<std::array<int, 2>> cell_counts(const std::string& name);
  /// Returns a text; where words are declared, one of them, or "" for false.
  std::optional<std::string> text(const std::string& name);
  std::optional<std::vector<std::string>> texts(const std::string& name);
  /// Returns a name that is not empty, and one of `known` if that has any. `what` is its name in messages.
  std::optional<std::string> known_name(const std::string& name, const std::string& what,
                                        const std::vector<std::string>& known);
  /// Returns one such name or a list of some, without repetitions.
  std::optional<std::vector<std::string>> name_list(const std::string& name, const std::string& what,
                                                    const std::vector<std::string>& known);
  std::optional<geometry::Expression> field(const std::string& name);
  std::optional<energy::VectorExpression> field_vector(const std::string& name);
  /// Returns the only key of Section::exactly_one that is given; reports none and several.
  std::optional<std::string> shape(const std::string& example, const std::string& advice_for_several = "") const;
  /// Reads a table by `read` and notes its effective settings. Returns false if there is no table.
  bool in_table(const std::string& name, const std::function<void(Table&)>& read);
  /// Reads each table of a list by `read` and notes their effective settings.
  void in_tables(const std::string& name, const std::function<void(Table&)>& read);
  /// Returns the keys that are not declared, in the order of the file: for sections that have other keys.
  std::vector<std::pair<std::string, toml::value>> other_entries() const;

  nlohmann::json effective = nlohmann::json::object();

 private:
  const Key& declared(const std::string& name) const;
  bool fill_keys(const std::any& object);
  const Section& section_of(const std::string& name) const;
  std::vector<Table> tables(const std::string& name) const;
  void report_unknown(const std::string& name, const toml::value& value) const;
  /// Whether an unknown key probably means this one.
  bool is_mistyped(const Key& key) const;
  void report_missing(const Key& key) const;
  std::optional<std::string> checked_name(const Item& item, const std::string& what,
                                          const std::vector<std::string>& known) const;
  void report_unknown_name(const Item& item, const std::string& what, const std::string& name,
                           const std::vector<std::string>& known) const;
  bool check_word(const Key& key, const Item& item, const std::string& word) const;
  template <class Read>
  auto read(const std::string& name, Read read_value);

  Reading* reading_;
  const Section* section_;
  toml::value value_;
};

/// Returns the number, or the text of an expression that depends on x or y.
nlohmann::json as_json(const geometry::Expression& field);

/// Declares a key that the reader of its section reads by its name. `rest`: what is not given here.
Key key(std::string name, Kind kind, Key rest, std::string meaning);

/// Declares a key whose value goes to a member of the object that Table::fill fills. `read` reads it from a table.
template <class Object, class Value, class Read>
Key key(std::string name, Value Object::*member, Read read, Key rest, std::string meaning) {
  rest.put = [member, read](Table& table, const Key& self, const std::any& object) {
    Object* const* const target = std::any_cast<Object*>(&object);
    if (target == nullptr) return true;  // a key of another object
    auto value = std::invoke(read, table, self.name);
    if (!value) return !self.required && !table.has(self.name);
    (*target)->*member = std::move(*value);
    return true;
  };
  const Kind kind = rest.kind;
  return key(std::move(name), kind, std::move(rest), std::move(meaning));
}

/// Returns the kind of key that a type of member has, and its reader.
template <class Value>
constexpr auto kind_and_reader() {
  if constexpr (std::is_same_v<Value, bool>) return std::pair(Kind::boolean, &Table::boolean);
  if constexpr (std::is_same_v<Value, int>) return std::pair(Kind::integer, &Table::integer);
  if constexpr (std::is_same_v<Value, double>) return std::pair(Kind::number, &Table::number);
  if constexpr (std::is_same_v<Value, std::vector<double>>) return std::pair(Kind::numbers, &Table::numbers);
  if constexpr (std::is_same_v<Value, std::vector<std::string>>) return std::pair(Kind::names, &Table::texts);
  if constexpr (std::is_same_v<Value, std::array<int, 2>>) return std::pair(Kind::cell_counts, &Table::cell_counts);
  if constexpr (std::is_same_v<Value, std::string>) return std::pair(Kind::name, &Table::text);
  if constexpr (std::is_same_v<Value, Eigen::Vector2d>) return std::pair(Kind::point, &Table::point);
  if constexpr (std::is_same_v<Value, Eigen::Vector3d>) return std::pair(Kind::vector, &Table::vector);
  if constexpr (std::is_same_v<Value, geometry::Expression>) return std::pair(Kind::field, &Table::field);
}

/// Declares a key whose kind follows from the type of the member.
template <class Object, class Value>
Key key(std::string name, Value Object::*member, Key rest, std::string meaning) {
  constexpr auto found = kind_and_reader<Value>();
  rest.kind = found.first;
  return key(std::move(name), member, found.second, std::move(rest), std::move(meaning));
}

/// Declares a key whose words stand for values of a member. With the default false, false stands for the value 0.
template <class Object, class Value>
Key key(std::string name, Value Object::*member,
        const std::vector<std::pair<std::string, std::type_identity_t<Value>>>& values, Key rest, std::string meaning) {
  rest.kind = rest.fallback == "false" ? Kind::word_or_false : Kind::word;
  for (const auto& [word, value] : values) rest.words.push_back(word);
  const auto read = [values](Table& table, const std::string& self) -> std::optional<Value> {
    const auto word = table.text(self);
    if (!word) return {};
    const auto found = std::ranges::find(values, *word, [](const auto& entry) { return entry.first; });
    return found == values.end() ? Value{} : found->second;
  };
  return key(std::move(name), member, read, std::move(rest), std::move(meaning));
}

}  // namespace plastron::config
