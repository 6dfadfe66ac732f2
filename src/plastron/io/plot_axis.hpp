// One axis of a plot: it maps values to positions, and has ticks with labels.
#pragma once
#include <string>
#include <vector>

namespace plastron::io {

struct Tick {
  double value;
  std::string label;  ///< empty for a minor tick
};

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
