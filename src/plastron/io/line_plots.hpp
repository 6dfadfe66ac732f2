// Profiles along a line of the case, from its line-NAME.csv. They show displacement, gap, reaction, resultants and
// stresses over the length.
#pragma once
#include <plastron/io/result_plots.hpp>

#include <string_view>

namespace plastron::io {

/// Returns the plots of `csv`, the table of line_csv() for the line of that name. They are named plot-line-NAME-FIELD.
/// Throws UnusableResults where it is no such table.
std::vector<NamedPlot> line_plots(const std::string& name, std::string_view csv);

}  // namespace plastron::io
