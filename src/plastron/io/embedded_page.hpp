// The parts of report.html that no computation changes, linked into the program (cmake/PlastronViewer.cmake): page and style from
// viewer/src as they are, the script bundled from viewer/src with vtk.js.
#pragma once
#include <string_view>

namespace plastron::io {

struct EmbeddedPage {
  std::string_view page;    ///< HTML with places {{...}} that report_html() fills
  std::string_view style;   ///< CSS
  std::string_view script;  ///< the three-dimensional view; empty where Plastron was built with PLASTRON_VIEWER=OFF
  std::string_view script_source;  ///< how the page's policy names it, by its hash; 'none' without
};
EmbeddedPage embedded_page();

}  // namespace plastron::io
