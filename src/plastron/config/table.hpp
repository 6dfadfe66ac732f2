// A table of the case file seen through its declaration: only declared keys exist, absent ones have their default.
// What is read is also noted as effective setting.
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
  /// True if the file gives the key.
  bool has(const std::string& name) const;
  Place key_place(const std::string& name) const;
  /// The value as it stands in the file, or the default. A required key that is absent is reported.
  std::optional<toml::value> value(const std::string& name) const;
  /// Reports something about the value of a key of the file.
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
  /// A text; where words are declared, one of them that this version can do.
  std::optional<std::string> text(const std::string& name);
  /// One of the declared words, or "" for false.
  std::optional<std::string> word_or_false(const std::string& name);
  std::optional<std::vector<std::string>> texts(const std::string& name);
  /// A name that is not empty, one of `known` if that has any; messages call it a `what`.
  std::optional<std::string> known_name(const std::string& name, const std::string& what,
                                        const std::vector<std::string>& known);
  /// One such name or a list of some, none of them twice.
  std::optional<std::vector<std::string>> name_list(const std::string& name, const std::string& what,
                                                    const std::vector<std::string>& known);
  std::optional<geometry::Expression> field(const std::string& name);
  std::optional<assembly::VectorExpression> field_vector(const std::string& name);
  std::optional<Table> table(const std::string& name) const;
  std::vector<Table> tables(const std::string& name) const;
  /// The keys that are not declared, in the order of the file: for sections that have other keys.
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

/// The number, or the text of an expression that depends on x or y.
nlohmann::json as_json(const geometry::Expression& field);

}  // namespace plastron::config
