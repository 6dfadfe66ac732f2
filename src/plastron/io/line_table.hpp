// Every field along the case's lines: line-NAME.csv.
#pragma once
#include <plastron/computation/problem.hpp>
#include <plastron/computation/result.hpp>
#include <plastron/io/atomic_file.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace plastron::io {

/// A header with names and units, then a row a point: the length along the undeformed mid-surface from the first point, by chords, and
/// every field, `heights` as of fields_of(). What is not defined is empty.
std::string line_csv(const std::vector<recovery::PointValues>& points, bool has_obstacle, bool has_multiplier,
                     std::span<const double> heights = {});

/// Adds a file for every line and returns their names (collective).
std::vector<std::string> add_lines(const computation::Solution& solution, const std::vector<computation::Line>& lines,
                                   std::span<const double> heights, const std::filesystem::path& directory,
                                   AtomicFiles& files);

}  // namespace plastron::io
