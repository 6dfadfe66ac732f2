// Profiles along a line of the case, from its line-NAME.csv: displacement, gap, reaction, resultants and stresses over the length.
#pragma once
#include <plastron/io/result_plots.hpp>

#include <string_view>

namespace plastron::io {

/// `csv` is what line_csv() has written for the line of that name; plots are named plot-line-NAME-FIELD. Throws UnusableResults where it is no such table.
std::vector<NamedPlot> line_plots(const std::string& name, std::string_view csv);

}  // namespace plastron::io
