// The line plots of report.html: how energy, reaction and contact settle from mesh to mesh, and the history of steps.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/study/plot.hpp>

#include <vector>

namespace plastron::io {

/// Those that have anything to show: two meshes at least, contact, steps.
std::vector<study::Plot> report_plots(const computation::Result& result);

}  // namespace plastron::io
