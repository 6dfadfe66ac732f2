#include <plastron/report/report_html.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plastron::report {

std::string valid_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) result += c;
        if (c == '\n' || c == '\t') result += ' ';
    }
  }
  return result;
}

std::string script_json(const Json& json) {
  std::string result;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    result += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return result;
}

std::string html_number(const Json& value, std::string_view path, double scale, int digits) {
  if (value.is_null()) return "<span class=\"rounding\">none</span>";
  if (!value.is_number()) return html_text(plain_words(value));
  const double number = value.get<double>();
  const bool is_rounding = std::abs(number) < 1e-9 * scale;
  return fmt::format("<span class=\"number{}\"{} title=\"{}\">{}</span>", is_rounding ? " rounding" : "",
                     path.empty() ? "" : fmt::format(" data-path=\"{}\"", html_text(path)), value.dump(),
                     value.is_number_float() ? fmt::format("{:.{}g}", number, is_rounding ? 2 : digits) : value.dump());
}

std::string plain_words(const Json& value) {
  if (value.is_null()) return "none";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return fmt::format("{:.7g}", value.get<double>());
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_structured()) return value.dump();
  std::string list;
  for (const auto& [key, entry] : value.items()) {
    list += list.empty() ? "" : ", ";
    list += value.is_object() ? key + " " + plain_words(entry) : plain_words(entry);
  }
  return "(" + list + ")";
}

HtmlTable::HtmlTable(const std::vector<std::string_view>& columns) {
  for (const std::string_view column : columns) {
    is_left_.push_back(column.starts_with('<'));
    head_ += fmt::format("<th{}>{}</th>", is_left_.back() ? " class=\"word\"" : "",
                         html_text(column.substr(is_left_.back() ? 1 : 0)));
  }
}

void HtmlTable::row(const std::vector<std::string>& cells, std::string_view css_class) {
  rows_ += css_class.empty() ? "<tr>" : fmt::format("<tr class=\"{}\">", css_class);
  for (std::size_t i = 0; i < cells.size(); ++i)
    rows_ += fmt::format("<td{}>{}</td>", i < is_left_.size() && is_left_[i] ? " class=\"word\"" : "", cells[i]);
  rows_ += "</tr>\n";
}

std::string HtmlTable::text() const {
  return fmt::format(
      "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"table\"><table>\n<thead><tr>{}</tr></thead>\n"
      "<tbody>\n{}</tbody></table></div>\n",
      head_, rows_);
}

std::string html_section(std::string_view id, std::string_view title, const std::string& content) {
  if (content.empty()) return "";
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, html_text(title), content);
}

const Json& at_path(const Json& json, std::string_view path) {
  static const Json none;
  const Json::json_pointer pointer("/" + std::string(path));
  return json.contains(pointer) ? json.at(pointer) : none;
}

std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& values) {
  std::string result;
  for (std::size_t open = page.find("{{"); open != std::string_view::npos; open = page.find("{{")) {
    const std::size_t close = page.find("}}", open);
    if (close == std::string_view::npos) break;
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto found = std::ranges::find(values, name, [](const auto& value) { return value.first; });
    if (found == values.end()) throw std::logic_error("the page has an unknown place {{" + std::string(name) + "}}");
    result.append(page.substr(0, open)).append(found->second);
    page.remove_prefix(close + 2);
  }
  return result.append(page);
}

}  // namespace plastron::report
