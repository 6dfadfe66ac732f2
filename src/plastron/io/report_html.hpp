// Pieces of HTML whose texts come from outside: titles and names may hold anything, and must stay text.
#pragma once
#include <plastron/io/quantities.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plastron::io {

/// What is no valid UTF-8 becomes U+FFFD.
std::string valid_utf8(const std::string& text);
/// For HTML text and quoted attributes: & < > " ' as entities, control characters left out.
std::string html_text(std::string_view text);
/// JSON that no HTML parser takes for markup inside of a script element: every '<' is written \u003c.
std::string script_json(const Json& json);
/// Seven digits, or "none" for null; three digits and muted where it is rounding beside `scale`. The span carries the place in results.json and
/// all digits for who looks: data-path, title.
std::string html_number(const Json& value, std::string_view path = "", double scale = 0);
/// A number, word, truth or list as short plain text, not escaped: "(0, 0, -0.002)".
std::string plain_words(const Json& value);

/// A table that scrolls sideways where it is wider than the page. Cells are HTML.
class HtmlTable {
 public:
  /// The first column of words is aligned left, numbers right: `columns` that begin with '<' are left.
  explicit HtmlTable(std::initializer_list<std::string_view> columns);
  void row(const std::vector<std::string>& cells, std::string_view css_class = "");
  std::string text() const;

 private:
  std::vector<bool> is_left_{};
  std::string head_{}, rows_{};
};

/// <section id=...><h2>title</h2>...; empty if the content is.
std::string html_section(std::string_view id, std::string_view title, const std::string& content);

/// The value under a path of steps separated by '/'; null where there is none.
const Json& at_path(const Json& json, std::string_view path);

/// The text with each {{name}} replaced by its value, once: what is filled in is not looked at again. Unknown names are a std::logic_error.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& values);

}  // namespace plastron::io
