// The data of the three-dimensional view in report.html, as JSON with base64 arrays of little-endian numbers: the
// shell, obstacles, boundaries of contact zones, supported edges. viewer/src/scene.js reads it.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/unit_names.hpp>

namespace plastron::io {

/// Largest number of points of the shell's surface on a page. The page stays below 12 MB (a field's 4 bytes are 5.3
/// letters, some 60 components).
inline constexpr std::int64_t most_report_points = 26'000;

/// Returns the scene on the first rank; null on the others, and if the surface is too large (collective). "fields" has
/// the entries of io/fields.hpp with "values": for each component a base64 array of floats, or one number if all values
/// are equal. Throws like sampled_surface().
Json scene_json(const computation::Solution& solution, const solution::Summary& summary,
                const problem::UnitNames& units = {}, std::int64_t most_points = most_report_points);

}  // namespace plastron::io
