// The history of a computation in steps as a table for spreadsheets and as a plot.
#pragma once
#include <plastron/io/quantities.hpp>
#include <plastron/study/plot.hpp>

#include <string>

namespace plastron::io {

/// A line of comma-separated values for each instant under one of names: all numbers and words of history_json(), paths with '.', the
/// obstacle's or probe's name in place of its number, components of vectors as _x, _y, _z. Values that are not finite are empty.
std::string history_csv(const computation::Result& result);

/// The force of each obstacle on the shell over the longest way that one has come; over the time where none has moved.
study::Plot history_plot(const computation::Result& result);

}  // namespace plastron::io
