// plastron parts: what a mesh in space consists of, for the writer of a case: regions, boundaries, folds.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/io/atomic_file.hpp>
#include <plastron/io/surface_page.hpp>
#include <plastron/io/surface_parts.hpp>

#include <fmt/format.h>

#include <numbers>

namespace plastron::app {

namespace {

void print_regions(const std::vector<io::RegionPart>& regions) {
  print("\n  {:<24} {:>7} {:>7} {:>13}  {:<34} {}\n", "region", "cells", "turned", "area [m^2]", "middle [m]",
        "mean normal a3");
  for (const io::RegionPart& region : regions)
    print("  {:<24} {:>7} {:>7} {:>13.6g}  {:<34} {}\n", io::name_text(region), region.cells, region.turned,
          region.area, topology::place_of(region.middle), io::normal_text(region));
}

void print_curves(const std::vector<io::CurvePart>& curves) {
  if (curves.empty()) return;
  print("\n  {:<24} {:>12} {:>8}  {:<22} {}\n", "curve", "length [m]", "angle", "edges", "from, to [m]");
  for (const io::CurvePart& curve : curves)
    if (curve.edges.empty())
      print("  {:<24} {:>12} {:>8}  {}\n", curve.name, "", "", "none: points");
    else
      print("  {:<24} {:>12.6g} {:>7.3g}°  {:<22} {}, {}\n", curve.name, curve.length,
            curve.largest_angle * 180 / std::numbers::pi, io::kinds_text(curve), topology::place_of(curve.low),
            topology::place_of(curve.high));
}

std::vector<io::PageFinding> on_page(const std::vector<examination::Finding>& findings) {
  std::vector<io::PageFinding> all;
  all.reserve(findings.size());
  for (const examination::Finding& finding : findings)
    all.push_back({finding.severity != examination::Severity::note, finding.text});
  return all;
}

/// Writes the page (collective).
ExitCode write_page(const std::string& path, const io::SurfacePage& page) {
  try {
    io::AtomicFiles files(MPI_COMM_WORLD);
    files.add_text(path, [&] { return io::surface_page_html(page); });
    files.commit();
  } catch (const io::WriteError& error) {
    print_error("error: {}; choose another place with --page\n", error.what());
    return bad_input;
  }
  print("\n{}\n", path);
  return solved;
}

}  // namespace

ExitCode parts(const PartsOptions& options) {
  if (!options.page.empty()) {
    const std::string mistake = io::page_name_mistake(options.page, options.file);
    if (!mistake.empty()) {
      print_error("error: {}\n", mistake);
      return bad_input;
    }
  }
  domain::SpaceReading reading{.scale = options.scale};
  if (options.size > 0) reading.size = options.size;
  if (options.smooth > 0) reading.smooth_angle = options.smooth * std::numbers::pi / 180;
  const domain::FileSurface surface = domain::read_surface({.path = options.file, .in_space = reading}, {});
  const auto findings = examination::surface_findings(surface);
  const auto regions = io::region_parts(surface);
  const auto curves = io::curve_parts(surface);
  if (is_first_rank()) {
    print("{}\n", options.file);
    print_findings(findings, options.file, true);
    print_regions(regions);
    print_curves(curves);
  }
  if (options.page.empty()) return solved;
  return write_page(options.page, {options.file, surface, regions, curves, on_page(findings)});
}

}  // namespace plastron::app
