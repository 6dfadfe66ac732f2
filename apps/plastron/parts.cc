// plastron parts: what a mesh in space consists of, for the writer of a case: regions, boundaries, folds.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/io/atomic_file.hpp>
#include <plastron/report/surface_page.hpp>
#include <plastron/report/surface_parts.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numbers>

namespace plastron::app {

namespace {

void print_regions(const std::vector<report::RegionPart>& regions) {
  print("\n  {:<24} {:>7} {:>7} {:>13}  {:<34} {}\n", "region", "cells", "turned", "area [m^2]", "middle [m]",
        "mean normal a3");
  for (const report::RegionPart& region : regions)
    print("  {:<24} {:>7} {:>7} {:>13.6g}  {:<34} {}\n", report::name_text(region), region.cells, region.turned,
          region.area, topology::place_of(region.middle), report::normal_text(region));
}

void print_curves(const std::vector<report::CurvePart>& curves) {
  if (curves.empty()) return;
  print("\n  {:<24} {:>12} {:>8}  {:<22} {}\n", "curve", "length [m]", "angle", "edges", "from, to [m]");
  for (const report::CurvePart& curve : curves)
    if (curve.edges.empty())
      print("  {:<24} {:>12} {:>8}  {}\n", curve.name, "", "", "none: points");
    else
      print("  {:<24} {:>12.6g} {:>7.3g}°  {:<22} {}, {}\n", curve.name, curve.length,
            curve.largest_angle * 180 / std::numbers::pi, report::kinds_text(curve), topology::place_of(curve.low),
            topology::place_of(curve.high));
}

std::vector<report::PageFinding> on_page(const std::vector<examination::Finding>& findings) {
  std::vector<report::PageFinding> all;
  all.reserve(findings.size());
  for (const examination::Finding& finding : findings)
    all.push_back({finding.severity != examination::Severity::note, with_unit_names(finding.text)});
  return all;
}

/// Writes the page (collective).
ExitCode write_page(const std::string& path, const report::SurfacePage& page) {
  try {
    io::AtomicFiles files(MPI_COMM_WORLD);
    files.add_text(path, [&] { return report::surface_page_html(page); });
    files.commit();
  } catch (const io::WriteError& error) {
    print_error("error: {}; choose another place with --page\n", error.what());
    return bad_input;
  }
  print("\n{}\n", path);
  return solved;
}

/// All faces of a CAD file, in mm times the scale. Numbers of a file without units are taken for mm.
std::string cad_job(const PartsOptions& options) {
  nlohmann::json job{{"unit", 1e-3 / options.scale}, {"default_unit", 1e-3}};
  if (options.size > 0) job["size"] = options.size;
  return job.dump();
}

}  // namespace

ExitCode parts(const PartsOptions& options) {
  if (!options.page.empty()) {
    const std::string mistake = report::page_name_mistake(options.page, options.file);
    if (!mistake.empty()) {
      print_error("error: {}\n", mistake);
      return bad_input;
    }
  }
  domain::SpaceReading reading{.scale = options.scale};
  if (options.size > 0) reading.size = options.size;
  if (options.smooth > 0) reading.smooth_angle = options.smooth * std::numbers::pi / 180;
  domain::MeshFile file{.path = options.file, .in_space = reading};
  const bool is_part = domain::is_cad_file(options.file);
  if (is_part) file.cad_job = cad_job(options);
  const domain::FileSurface surface = domain::read_surface(file, {});
  const auto findings = examination::surface_findings(surface, is_part);
  const auto regions = report::region_parts(surface);
  const auto curves = report::curve_parts(surface);
  // A file of a mesh names no units; lengths of a CAD file are converted.
  set_unit_names({.length = is_part && options.scale == 1 ? "mm" : "units"});
  if (is_first_rank()) {
    print("{}, lengths in {}{}\n", options.file, is_part ? "mm" : "the units of the file",
          options.scale == 1 ? "" : fmt::format(" times {:g}", options.scale));
    print_findings(findings, options.file, true);
    print_regions(regions);
    print_curves(curves);
  }
  if (options.page.empty()) return solved;
  return write_page(options.page, {options.file, surface, regions, curves, on_page(findings)});
}

}  // namespace plastron::app
