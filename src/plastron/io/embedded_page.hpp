// The parts of report.html that do not depend on the computation, linked into the program (cmake/PlastronViewer.cmake).
// Page and style are copied from viewer/src; the script is bundled from viewer/src with vtk.js.
#pragma once
#include <string_view>

namespace plastron::io {

struct EmbeddedPage {
  std::string_view page;    ///< HTML with places {{...}} that report_html() fills
  std::string_view style;   ///< CSS
  std::string_view script;  ///< the three-dimensional view; empty where Plastron was built with PLASTRON_VIEWER=OFF
  std::string_view script_source;  ///< hash of the script, its name in the page's policy; 'none' without script
};
EmbeddedPage embedded_page();

}  // namespace plastron::io
