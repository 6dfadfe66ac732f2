// Tables for spreadsheets: every field along the case's lines (line-NAME.csv), and the history of a computation in steps
// (history.csv).
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/io/fields.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::io {

/// Returns a header with names and units, then one row for each point: the length along the undeformed mid-surface from
/// the first point, by chords, and every field, with the heights and names of units of `given`. Undefined values are
/// empty.
std::string line_csv(const std::vector<recovery::PointValues>& points, const Ingredients& ingredients,
                     const problem::Output& given = {});

struct LineTable {
  std::string name;  ///< name of the line
  std::string csv;   ///< table of line_csv(), on the first rank
};
/// Returns the tables of all lines (collective).
std::vector<LineTable> line_tables(const computation::Solution& solution, const std::vector<problem::Line>& lines,
                                   const problem::Output& given);

/// Returns a line of names, then one line of comma-separated values for each instant: all numbers and words of
/// history_json(). Paths have '.', and the obstacle's or probe's name in place of its number. Components of vectors are
/// _x, _y, _z, components of tensors have their names in the fields, N_11. Values that are not finite are empty.
std::string history_csv(const computation::Result& result);

}  // namespace plastron::io
