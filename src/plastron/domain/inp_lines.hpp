// The lines of an Abaqus or CalculiX input file: keyword lines with parameters, data lines with fields between commas.
// Comments (**) and blank lines are left out, blanks around words and the case of letters do not matter.
#pragma once
#include <plastron/geometry/text_file.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::domain {

/// Numbers of nodes and elements are from 1 to this.
constexpr std::int64_t largest_label = 999'999'999'999;

/// The text in capital letters: two names are equal if their capitals are.
std::string capitals(std::string_view text);

/// A keyword line: *ELEMENT, TYPE=S4, ELSET="Top side".
struct InpKeyword {
  std::string name{};                                                  ///< "ELEMENT", words separated by one blank
  std::size_t line = 0;                                                ///< line of the file
  std::vector<std::pair<std::string, std::string_view>> parameters{};  ///< name in capitals; value without quotes

  bool has(std::string_view parameter) const { return value(parameter).has_value(); }
  std::optional<std::string_view> value(std::string_view parameter) const;
};

class InpLines {
 public:
  /// Reads the file and moves to its first line. Throws FileError as TextFile does.
  explicit InpLines(const std::string& path);

  const geometry::TextFile& text() const { return text_; }
  std::size_t line_number() const { return text_.line_number(); }
  [[noreturn]] void refuse(const std::string& what) const { text_.refuse(what); }

  bool at_end() const { return at_end_; }
  /// Reads the keyword of the current line. After a comma at its end, its parameters continue on the next line, unless
  /// that does not begin with a letter. Refuses a data line.
  InpKeyword keyword();
  /// Moves to the next line. Returns false at the end of the file and at a keyword.
  bool next_data();
  void skip_data();

  // The fields of the current data line.
  std::size_t field_count() const { return fields_.size(); }
  /// Returns a field without blanks; empty if the line has fewer fields.
  std::string_view field(std::size_t i) const { return i < fields_.size() ? fields_[i] : std::string_view{}; }
  bool ends_with_comma() const { return text_.line().ends_with(','); }
  /// The number of a node or an element. `what` says in messages what should stand there.
  std::int64_t label(std::size_t i, const char* what) const;
  bool is_label(std::size_t i) const;
  /// A finite number, also in Fortran's form 1.5D-3. An empty field is 0.
  double real(std::size_t i, const char* what) const;

 private:
  void advance();
  bool is_keyword() const { return text_.line().starts_with('*'); }
  void add_parameters(InpKeyword& keyword, std::size_t first) const;

  geometry::TextFile text_;
  bool at_end_ = false;
  bool is_ahead_ = false;  ///< true if keyword() has moved to the line after the keyword
  std::vector<std::string_view> fields_{};
};

}  // namespace plastron::domain
