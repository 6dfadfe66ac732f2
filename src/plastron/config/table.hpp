// A table of the case file with its declaration: only declared keys exist, absent ones have their default.
// Values that are read are also noted as effective settings.
#pragma once
#include <plastron/assembly/loads.hpp>
#include <plastron/config/reading.hpp>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace plastron::config {

class Table {
 public:
  /// Reports the keys of `value` that are not declared.
  Table(Reading& reading, const Section& section, toml::value value);

  Reading& reading() const { return *reading_; }
  Place place() const;
  /// Returns true if the file gives the key.
  bool has(const std::string& name) const;
  Place key_place(const std::string& name) const;
  /// Returns the value in the file, or the default. A required key that is absent is reported.
  std::optional<toml::value> value(const std::string& name) const;
  /// Reports a mistake in the value of a key of the file.
  void report(const std::string& name, std::string what, std::string allowed = "", std::string advice = "") const;

  std::optional<bool> boolean(const std::string& name);
  std::optional<int> integer(const std::string& name);
  std::optional<double> number(const std::string& name);
  std::optional<std::vector<double>> numbers(const std::string& name);
  std::optional<Eigen::Vector2d> point(const std::string& name);
  std::optional<Eigen::Vector3d> vector(const std::string& name);
  std::optional<std::vector<Eigen::Vector2d>> points(const std::string& name);
  std::optional<std::vector<Eigen::Vector3d>> vectors(const std::string& name);
  std::optional<std::array<int, 2>> cell_counts(const std::string& name);
  /// Returns a text; where words are declared, one of the words that this version supports.
  std::optional<std::string> text(const std::string& name);
  /// Returns one of the declared words, or "" for false.
  std::optional<std::string> word_or_false(const std::string& name);
  std::optional<std::vector<std::string>> texts(const std::string& name);
  /// Returns a name that is not empty, and one of `known` if that has any. `what` is its name in messages.
  std::optional<std::string> known_name(const std::string& name, const std::string& what,
                                        const std::vector<std::string>& known);
  /// Returns one such name or a list of some, without repetitions.
  std::optional<std::vector<std::string>> name_list(const std::string& name, const std::string& what,
                                                    const std::vector<std::string>& known);
  std::optional<geometry::Expression> field(const std::string& name);
  std::optional<assembly::VectorExpression> field_vector(const std::string& name);
  std::optional<Table> table(const std::string& name) const;
  std::vector<Table> tables(const std::string& name) const;
  /// Returns the keys that are not declared, in the order of the file: for sections that have other keys.
  std::vector<std::pair<std::string, toml::value>> other_entries() const;

  nlohmann::json effective = nlohmann::json::object();

 private:
  const Key& declared(const std::string& name) const;
  void report_unknown(const std::string& name, const toml::value& value) const;
  void report_missing(const Key& key) const;
  std::optional<std::string> checked_name(const Item& item, const std::string& what,
                                          const std::vector<std::string>& known) const;
  void report_unknown_name(Place place, const std::string& what, const std::string& name,
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

}  // namespace plastron::config
