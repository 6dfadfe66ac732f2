// The history of a computation in steps as a table for spreadsheets.
#pragma once
#include <plastron/io/quantities.hpp>

#include <string>

namespace plastron::io {

/// A line of comma-separated values for each instant under one of names: all numbers and words of history_json(), paths with '.', the
/// obstacle's or probe's name in place of its number, components of vectors as _x, _y, _z, those of tensors as the fields have them, N_11. Values that are not finite are empty.
std::string history_csv(const computation::Result& result);

}  // namespace plastron::io
