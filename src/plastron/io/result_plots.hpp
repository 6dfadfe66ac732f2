// The line plots of a result: how energy, reaction and contact settle from mesh to mesh, and the history of steps. They are made from
// results.json, so that report.html and `plastron plot` show the same.
#pragma once
#include <plastron/computation/unit_names.hpp>
#include <plastron/io/quantities.hpp>
#include <plastron/study/plot.hpp>

#include <iosfwd>
#include <string>
#include <vector>

namespace plastron::io {

/// A plot and the name of its file, without folder and ending.
struct NamedPlot {
  std::string name;
  study::Plot plot;
};

/// The parts of results.json that plots are made of. The others are read over: a file of 200 000 meshes would fill 3 GB. Throws Json::exception.
Json parts_to_plot(std::istream& results);

/// Those that have anything to show: two meshes at least, contact, steps. Throws Json::exception where `results` is not as results_json() makes it.
std::vector<NamedPlot> result_plots(const Json& results);

/// What results.json says of names of units; those of SI where it says nothing.
computation::UnitNames unit_names(const Json& results);
/// The plot with names of units in its labels.
study::Plot renamed(study::Plot plot, const computation::UnitNames& units);

/// The force of each obstacle on the shell over the longest way that one has come; over the time where none has moved. `history` is that of
/// results.json.
study::Plot history_plot(const Json& history);

}  // namespace plastron::io
