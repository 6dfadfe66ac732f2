// Every field along the case's lines: line-NAME.csv.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace plastron::io {

/// A header with names and units, then a row a point: the length along the undeformed mid-surface from the first point, by chords, and
/// every field. What is not defined is empty.
std::string line_csv(const std::vector<recovery::PointValues>& points, bool has_obstacle, bool has_multiplier);

/// Adds a file for every line and returns their names (collective).
std::vector<std::string> add_lines(const computation::Solution& solution, const std::vector<computation::Line>& lines,
                                   const std::filesystem::path& directory, AtomicFiles& files);

}  // namespace plastron::io
