// The line plots of a result: convergence of energy, reaction and contact from mesh to mesh, the history of steps, and
// profiles along lines of the case. They are made from results.json and line-NAME.csv, so that report.html and
// `plastron plot` show the same.
#pragma once
#include <plastron/io/plot.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/problem/unit_names.hpp>

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace plastron::io {

/// A plot and the name of its file, without folder and extension.
struct NamedPlot {
  std::string name;
  Plot plot;
};

/// Reads the parts of results.json that plots need. The others are skipped: a file of 200 000 meshes would fill 3 GB.
/// Throws Json::exception.
Json parts_to_plot(std::istream& results);

/// Returns the plots with content: at least two meshes, contact, steps. Throws Json::exception if `results` is not in
/// the form of results_json().
std::vector<NamedPlot> result_plots(const Json& results);

/// Returns the names of units in results.json; SI units if it has none.
problem::UnitNames unit_names(const Json& results);
/// Returns the plot with names of units in its labels.
Plot renamed(Plot plot, const problem::UnitNames& units);

/// Plots the force of each obstacle on the shell over the longest distance that an obstacle has moved, or over the time if
/// none has moved. Where the loads follow a displacement, it plots their factor. `history` is from results.json.
Plot history_plot(const Json& history);

/// Returns the plots of `csv`, the table of line_csv() for the line of that name: displacement, gap, reaction, resultants
/// and stresses over the length. They are named plot-line-NAME-FIELD. Throws UnusableResults where it is no such table.
std::vector<NamedPlot> line_plots(const std::string& name, std::string_view csv);

}  // namespace plastron::io
