// The parts of the pages that do not depend on a computation: page and style are copied from viewer/src, the script is
// bundled from viewer/src with vtk.js (cmake/PlastronViewer.cmake).
#pragma once
#include <string>
#include <string_view>

namespace plastron::report {

struct EmbeddedPage {
  std::string_view page;    ///< HTML with places {{...}}, see page_html()
  std::string_view style;   ///< CSS
  std::string_view script;  ///< the three-dimensional view; empty where Plastron was built with PLASTRON_VIEWER=OFF
  std::string_view script_source;  ///< hash of the script, its name in the page's policy; 'none' without script
};
EmbeddedPage embedded_page();

/// What differs from page to page, as HTML; `results` and `scene` as JSON for a script element (script_json()).
struct PageContent {
  std::string title{}, kind{};  ///< `kind`: class of <main>, by which the style differs
  std::string version{}, content{}, footer{}, results = "null", scene = "null";
};
/// Returns a whole page.
std::string page_html(const PageContent& content);

/// Returns the place of the three-dimensional view, which the script fills.
std::string view_place_html();

}  // namespace plastron::report
