// A line plot as SVG: log or linear axes, markers, legend, reference slopes; readable on light and dark pages.
#pragma once
#include <plastron/study/plot.hpp>

#include <string>

namespace plastron::io {

/// Place of the legend: beside the plot on a wide page, below it on a page half as wide, which is still readable on a
/// phone.
enum class PlotLayout { wide, narrow };

/// Returns a complete SVG file. Texts may contain any UTF-8; points that cannot be drawn are omitted.
std::string svg_text(const study::Plot& plot, PlotLayout layout = PlotLayout::wide);

}  // namespace plastron::io
