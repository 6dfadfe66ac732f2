// The history of a computation in steps as a table for spreadsheets.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>

namespace plastron::io {

/// Returns a line of names, then one line of comma-separated values for each instant: all numbers and words of
/// history_json(). Paths have '.', and the obstacle's or probe's name in place of its number. Components of vectors are
/// _x, _y, _z, components of tensors have their names in the fields, N_11. Values that are not finite are empty.
std::string history_csv(const computation::Result& result);

}  // namespace plastron::io
