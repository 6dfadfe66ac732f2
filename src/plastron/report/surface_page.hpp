// The page of `plastron parts --page`: a mesh in space that can be turned round, with the tables of the terminal beside.
// It opens in any browser without a network, like report.html, and shares its script (viewer/).
#pragma once
#include <plastron/io/quantities.hpp>
#include <plastron/report/surface_parts.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::report {

/// A finding of the examination.
struct PageFinding {
  bool is_warning = false;
  std::string text;
};

/// What the page shows.
struct SurfacePage {
  std::string file;  ///< as the user named it
  const domain::FileSurface& surface;
  const std::vector<RegionPart>& regions;
  const std::vector<CurvePart>& curves;
  const std::vector<PageFinding>& findings;
};

/// Returns the page. Names may contain anything.
std::string surface_page_html(const SurfacePage& page);

/// Returns why the page cannot have this name: a name without ending .html, or an input. Empty if it can.
std::string page_name_mistake(const std::filesystem::path& path, const std::filesystem::path& mesh);

}  // namespace plastron::report
