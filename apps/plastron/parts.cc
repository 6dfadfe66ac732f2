// plastron parts: what a mesh in space consists of, for the writer of a case: regions, boundaries, folds.
#include "command_line.hpp"
#include "console.hpp"
#include "terminal.hpp"

#include <plastron/fem/surface_mesh.hpp>
#include <plastron/fem/surface_patch.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace plastron::app {

namespace {

using Eigen::Vector3d;

struct RegionRow {
  std::size_t cells = 0, turned = 0;
  double area = 0;
  Vector3d area_vector = Vector3d::Zero(), centre = Vector3d::Zero();
};

std::vector<RegionRow> rows_of_regions(const fem::FileSurface& surface) {
  const fem::SurfaceTopology& topology = surface.topology;
  std::vector<RegionRow> rows(surface.regions.size());
  const auto integrals = fem::patch_integrals(topology.mesh, Vector3d::Zero());
  for (std::size_t c = 0; c < topology.mesh.cells.size(); ++c) {
    const fem::SurfaceCell& cell = topology.mesh.cells[c];
    RegionRow& row = rows[static_cast<std::size_t>(cell.region)];
    ++row.cells;
    row.turned += topology.is_turned[c] ? 1 : 0;
    row.area += integrals[c].area;
    row.area_vector += integrals[c].area_vector;
    Vector3d middle = Vector3d::Zero();
    for (const std::int32_t node : cell.nodes)
      middle += topology.mesh.nodes[static_cast<std::size_t>(node)] / static_cast<double>(cell.nodes.size());
    row.centre += integrals[c].area * middle;
  }
  return rows;
}

void print_regions(const fem::FileSurface& surface) {
  print("\n  {:<24} {:>7} {:>7} {:>13}  {:<34} {}\n", "region", "cells", "turned", "area [m^2]", "middle [m]",
        "mean normal a3");
  const auto rows = rows_of_regions(surface);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RegionRow& row = rows[r];
    const double part = row.area_vector.norm() / row.area;  // 0 for a closed region
    print("  {:<24} {:>7} {:>7} {:>13.6g}  {:<34} {}\n", surface.regions[r].empty() ? "(no name)" : surface.regions[r],
          row.cells, row.turned, row.area, fem::place_of(Vector3d(row.centre / row.area)),
          part < 1e-6 ? "none: closed"
                      : fmt::format("({:.3f})", fmt::join(Vector3d(row.area_vector.normalized().array() + 0.0), ", ")));
  }
}

struct CurveRow {
  std::string name;
  std::map<fem::EdgeKind, std::size_t> kinds{};
  double length = 0, largest_angle = 0;
  Vector3d low = Vector3d::Constant(INFINITY), high = Vector3d::Constant(-INFINITY);
};

void add_edge(const fem::SurfaceTopology& topology, const fem::SurfaceEdge& edge, CurveRow& row) {
  ++row.kinds[edge.kind];
  row.largest_angle = std::max(row.largest_angle, edge.angle);
  const fem::MeshEdge& side = topology.sides[edge.first_side];
  const auto& nodes = topology.mesh.cells[side.cell].nodes;
  const std::vector<int> places = fem::ascending_places(topology.mesh, side);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return topology.mesh.nodes[static_cast<std::size_t>(nodes[static_cast<std::size_t>(places[k])])];
    };
    row.low = row.low.cwiseMin(at(i));
    row.high = row.high.cwiseMax(at(i));
    if (i > 0) row.length += (at(i) - at(i - 1)).norm();
  }
}

std::string kinds_of(const CurveRow& row) {
  static const std::map<fem::EdgeKind, const char*> words{{fem::EdgeKind::border, "border"},
                                                          {fem::EdgeKind::smooth, "smooth"},
                                                          {fem::EdgeKind::fold, "fold"},
                                                          {fem::EdgeKind::branch, "branch"}};
  std::vector<std::string> texts;
  for (const auto& [kind, number] : row.kinds) texts.push_back(fmt::format("{} {}", number, words.at(kind)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

void print_curves(const fem::FileSurface& surface) {
  std::vector<CurveRow> rows;
  for (const std::string& name : surface.boundaries) rows.push_back({.name = name});
  std::vector<bool> is_named(surface.topology.edges.size(), false);
  for (const fem::NamedEdge& named : surface.named_edges) {
    is_named[named.edge] = true;
    add_edge(surface.topology, surface.topology.edges[named.edge], rows[static_cast<std::size_t>(named.boundary)]);
  }
  CurveRow rest{.name = "(borders without name)"}, folds{.name = "(folds without name)"};
  for (std::size_t e = 0; e < is_named.size(); ++e) {
    const fem::SurfaceEdge& edge = surface.topology.edges[e];
    if (is_named[e] || edge.kind == fem::EdgeKind::smooth) continue;
    add_edge(surface.topology, edge, edge.kind == fem::EdgeKind::border ? rest : folds);
  }
  for (const CurveRow& row : {rest, folds})
    if (!row.kinds.empty()) rows.push_back(row);
  if (rows.empty()) return;
  print("\n  {:<24} {:>12} {:>8}  {:<22} {}\n", "curve", "length [m]", "angle", "edges", "from, to [m]");
  for (const CurveRow& row : rows)
    print("  {:<24} {:>12.6g} {:>7.3g}°  {:<22} {}, {}\n", row.name, row.length,
          row.largest_angle * 180 / std::numbers::pi, kinds_of(row), fem::place_of(row.low), fem::place_of(row.high));
}

}  // namespace

ExitCode parts(const PartsOptions& options) {
  fem::SpaceReading reading{.scale = options.scale};
  if (options.smooth > 0) reading.smooth_angle = options.smooth * std::numbers::pi / 180;
  const fem::FileSurface surface = fem::read_surface({.path = options.file, .in_space = reading}, {});
  if (!is_first_rank()) return solved;
  print("{}\n", options.file);
  print_findings(examination::surface_findings(surface), options.file, true);
  print_regions(surface);
  print_curves(surface);
  return solved;
}

}  // namespace plastron::app
