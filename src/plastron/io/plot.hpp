// A line plot as plain values, and drawn as SVG: log or linear axes, markers, legend, reference slopes. It is readable on
// light and dark pages.
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
  /// Equally many values; points that cannot be drawn (not finite, or not positive on a log axis) are omitted.
  std::vector<double> x, y;
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

struct Tick {
  double value;
  std::string label;  ///< empty for a minor tick
};

/// One axis of a plot: it maps values to positions, and has ticks with labels.
class PlotAxis {
 public:
  /// Makes an axis for all `values` that can be drawn, from `begin` to `end` [px].
  PlotAxis(const std::vector<double>& values, bool is_log, double begin, double end);

  /// Whether a value is finite, positive on a log axis, and of a size that keeps the axis' width finite.
  static bool can_draw(double value, bool is_log);
  bool can_draw(double value) const { return can_draw(value, is_log_); }
  double position(double value) const;  ///< [px]
  /// Length of a unit, of a decade on a log axis [px].
  double per_unit() const;
  const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  double scaled(double value) const;
  void widen();
  void make_log_ticks();
  void make_linear_ticks();

  bool is_log_;
  double begin_, end_;
  double low_ = 0, high_ = 1;  // limits of the scaled values
  std::vector<Tick> ticks_;
};

}  // namespace plastron::io
