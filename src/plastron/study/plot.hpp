// A line plot as plain values: what is drawn, not how (io/plot.hpp draws it).
#pragma once
#include <string>
#include <vector>

namespace plastron::study {

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

}  // namespace plastron::study
