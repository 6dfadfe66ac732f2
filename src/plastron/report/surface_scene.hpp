// The data of the three-dimensional view of a mesh in space, as JSON with base64 arrays of little-endian numbers: cells
// with regions, and the edges that are drawn, with their kinds and names. readParts() in viewer/src/scene.js reads it.
#pragma once
#include <plastron/io/quantities.hpp>
#include <plastron/report/surface_parts.hpp>

namespace plastron::report {

using io::Json;

/// Largest number of points of the view. Below `most_smooth_points` cells of order 2 or more are drawn with several facets.
inline constexpr std::size_t most_parts_points = 1'000'000, most_smooth_points = 200'000;

/// Returns the number of facets along a cell's side: 1 for order 1, otherwise 4 or the order if it is larger, less for
/// large meshes; 0 if there are more than `most_points` points even with 1.
int parts_subdivisions(const topology::SpaceMesh& mesh, std::size_t most_points = most_parts_points,
                       std::size_t most_smooth = most_smooth_points);

/// Returns the scene; null if the mesh has too many cells. Points are relative to "origin", so that single precision
/// suffices for a part far from (0, 0, 0).
///   cells: "points" and "normals" (a3) on lattice(shape, subdivisions) of each; "region", "number" and "line" in the
///   file, "turned" of each cell
///   edges: "kind" (index of "kinds"), "angle" [degrees], "doubtful", "places": subdivisions + 1 numbers of points for
///   each, "sides": for each side of each cell 1 + its edge, or 0
///   curves: name, "edges", "marks": numbers of points at which the name stands
///   "length": the name of the unit of lengths
Json surface_scene_json(const domain::FileSurface& surface, const std::vector<RegionPart>& regions,
                        const std::vector<CurvePart>& curves, std::size_t most_points = most_parts_points);

}  // namespace plastron::report
