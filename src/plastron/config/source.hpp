// The text of a case file and the places in it: toml11 gives the place of a value, this class also finds keys and
// characters.
#pragma once
#include <plastron/config/mistakes.hpp>

#include <string>
#include <toml.hpp>
#include <vector>

namespace plastron::config {

/// A part of the text, in bytes from its beginning.
struct Place {
  std::size_t offset = 0;
  std::size_t length = 1;
};

class Source {
 public:
  /// Throws CaseErrors if the text is empty or not UTF-8.
  Source(std::string text, std::string file_name);

  const std::string& text() const { return text_; }
  const std::string& file_name() const { return file_name_; }

  std::size_t offset(std::size_t line, std::size_t column) const;

  /// Returns the place of a value as written; for a table with a header, its header.
  Place value(const toml::value& value) const;
  /// Returns the place of a value's key.
  Place key(const std::string& name, const toml::value& value) const;
  /// Returns the place of character `position` of a string value, with the identifier that begins there.
  Place inside(const toml::value& string, std::size_t position) const;

  Mistake mistake(Place place, std::string what, std::string allowed = "", std::string advice = "") const;

 private:
  std::string text_, file_name_;
  std::vector<std::size_t> line_begins_;
};

/// Returns the file's content. Throws CaseErrors with one clear message if it is not TOML.
toml::value parse_toml(const Source& source);

}  // namespace plastron::config
