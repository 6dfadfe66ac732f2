#include <plastron/report/embedded_page.hpp>

#include <plastron/report/report_html.hpp>

// Defined in embedded_page.S, which includes the files without change.
extern "C" {
extern const char plastron_page_begin[], plastron_page_end[];
extern const char plastron_style_begin[], plastron_style_end[];
extern const char plastron_script_begin[], plastron_script_end[];
extern const char plastron_script_source_begin[], plastron_script_source_end[];
}

namespace plastron::report {

namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

EmbeddedPage embedded_page() {
  return {.page = between(plastron_page_begin, plastron_page_end),
          .style = between(plastron_style_begin, plastron_style_end),
          .script = between(plastron_script_begin, plastron_script_end),
          .script_source = between(plastron_script_source_begin, plastron_script_source_end)};
}

std::string page_html(const PageContent& content) {
  const EmbeddedPage parts = embedded_page();
  return filled(parts.page, {{"title", content.title},
                             {"kind", content.kind},
                             {"style", std::string(parts.style)},
                             {"version", content.version},
                             {"content", content.content},
                             {"footer", content.footer},
                             {"results", content.results},
                             {"scene", content.scene},
                             {"script_source", std::string(parts.script_source)},
                             {"script", std::string(parts.script)}});
}

std::string view_place_html() {
  return "<div id=\"view\"><noscript><p class=\"note\">The three-dimensional view needs JavaScript. The other parts of "
         "this page do not.</p></noscript></div>\n";
}

}  // namespace plastron::report
