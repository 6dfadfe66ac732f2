#include <plastron/io/embedded_page.hpp>

#include <cstddef>

// Defined in embedded_page.S, which includes the files without change.
extern "C" {
extern const char plastron_page_begin[], plastron_page_end[];
extern const char plastron_style_begin[], plastron_style_end[];
extern const char plastron_script_begin[], plastron_script_end[];
extern const char plastron_script_source_begin[], plastron_script_source_end[];
}

namespace plastron::io {

namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

EmbeddedPage embedded_page() {
  return {.page = between(plastron_page_begin, plastron_page_end),
          .style = between(plastron_style_begin, plastron_style_end),
          .script = between(plastron_script_begin, plastron_script_end),
          .script_source = between(plastron_script_source_begin, plastron_script_source_end)};
}

}  // namespace plastron::io
