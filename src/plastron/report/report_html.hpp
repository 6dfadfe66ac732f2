// Pieces of HTML with texts from outside. Titles and names may contain anything, and must remain text.
#pragma once
#include <plastron/io/quantities.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::report {

using io::Json;

/// Returns the text with invalid UTF-8 replaced by U+FFFD.
std::string valid_utf8(const std::string& text);
/// Returns HTML for text and quoted attributes: & < > " ' as entities, without control characters.
std::string html_text(std::string_view text);
/// Returns JSON that no HTML parser reads as markup in a script element: every '<' is written \u003c.
std::string script_json(const Json& json);
/// Returns `digits` digits, or "none" for null; integers have all. A number that is only rounding relative to `scale` has
/// two digits and is muted. The span has the place in results.json and all digits: data-path, title.
std::string html_number(const Json& value, std::string_view path = "", double scale = 0, int digits = 7);
/// Returns a number, word, truth value or list as short plain text, not escaped: "(0, 0, -0.002)".
std::string plain_words(const Json& value);

/// A table that scrolls horizontally where it is wider than the page. Cells are HTML.
class HtmlTable {
 public:
  /// The first column of words is aligned left, numbers are aligned right. `columns` that begin with '<' are left.
  explicit HtmlTable(const std::vector<std::string_view>& columns);
  void row(const std::vector<std::string>& cells, std::string_view css_class = "");
  std::string text() const;

 private:
  std::vector<bool> is_left_{};
  std::string head_{}, rows_{};
};

/// Returns <section id=...><h2>title</h2>...; empty if the content is empty.
std::string html_section(std::string_view id, std::string_view title, const std::string& content);

/// Returns the value at a path of steps separated by '/'; null if there is none.
const Json& at_path(const Json& json, std::string_view path);

/// Returns the text with each {{name}} replaced by its value, once: inserted text is not searched again. Throws
/// std::logic_error for unknown names.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace plastron::report
