// A line plot as plain values, and drawn as SVG: log or linear axes, markers, legend, reference slopes; readable on light and dark pages.
#pragma once
#include <string>
#include <vector>

namespace plastron::io {

struct Axis {
  std::string label;  ///< with its unit
  bool is_log = false;
};

struct Series {
  std::string label;
  std::vector<double> x,
      y;  ///< of one length; points that cannot be drawn (not finite, or not positive on a log axis) are left out
  bool dashed = false;
  bool with_line = true, with_markers = true;
};

/// y ~ x^exponent, shown for comparison in log-log plots.
struct ReferenceSlope {
  double exponent = 1;
  std::string label{};
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series{};
  std::vector<ReferenceSlope> slopes{};
};

/// Place of the legend: beside the plot on a wide page, below it on a page half as wide, which is still readable on a
/// phone.
enum class PlotLayout { wide, narrow };

/// Returns a complete SVG file. Texts may contain any UTF-8; points that cannot be drawn are omitted.
std::string svg_text(const Plot& plot, PlotLayout layout = PlotLayout::wide);

}  // namespace plastron::io
