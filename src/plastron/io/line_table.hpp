// Tables of every field along the case's lines: line-NAME.csv.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::io {

/// Returns a header with names and units, then one row for each point: the length along the undeformed mid-surface from
/// the first point, by chords, and every field, with the heights and names of units of `given`. Undefined values are
/// empty.
std::string line_csv(const std::vector<recovery::PointValues>& points, bool has_obstacle, bool has_multiplier,
                     const problem::Output& given = {});

struct LineTable {
  std::string name;  ///< name of the line
  std::string csv;   ///< table of line_csv(), on the first rank
};
/// Returns the tables of all lines (collective).
std::vector<LineTable> line_tables(const computation::Solution& solution, const std::vector<problem::Line>& lines,
                                   const problem::Output& given);

}  // namespace plastron::io
