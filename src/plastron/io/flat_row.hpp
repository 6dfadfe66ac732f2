// A part of results.json as a row of a table. history.csv and the tables of sweeps are made of such rows.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>
#include <utility>
#include <vector>

namespace plastron::io {

using Row = std::vector<std::pair<std::string, std::string>>;  ///< column and text of each cell

/// Returns all numbers and words of a record. Paths have '.', and the name of an obstacle or probe in place of its number.
/// Components of vectors are _x, _y, _z, components of tensors have their names in the fields, N_11. Values that are not
/// finite are empty.
Row flat_row(const Json& record);

/// Returns the row of a whole results.json: its numbers, without its levels, instants, settings and descriptions.
Row result_row(Json results);

/// Returns the text in quotes if a comma, a quote or the end of a line would break the table.
std::string csv_cell(const std::string& text);

}  // namespace plastron::io
