#include <plastron/io/plot_axis.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plastron::io {

namespace {

/// Returns 10 to an integer power, with a superscript exponent.
std::string power_of_ten(int exponent) {
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char d : std::to_string(std::abs(exponent))) text += digits[d - '0'];
  return text;
}

std::string log_label(int mantissa, int exponent) {
  if (exponent >= -3 && exponent <= 3) return fmt::format("{:g}", mantissa * std::pow(10.0, exponent));
  return mantissa == 1 ? power_of_ten(exponent) : fmt::format("{}·{}", mantissa, power_of_ten(exponent));
}

/// Limits within which sums and quotients are also doubles.
constexpr double smallest_drawn = 1e-300, largest_drawn = 1e300;

}  // namespace

PlotAxis::PlotAxis(const std::vector<double>& values, bool is_log, double begin, double end)
    : is_log_(is_log), begin_(begin), end_(end) {
  bool first = true;
  for (const double value : values) {
    if (!can_draw(value)) continue;
    low_ = first ? scaled(value) : std::min(low_, scaled(value));
    high_ = first ? scaled(value) : std::max(high_, scaled(value));
    first = false;
  }
  widen();
  if (is_log_)
    make_log_ticks();
  else
    make_linear_ticks();
}

/// Adds space beside the values. Values that differ by rounding only count as equal. A log axis has at least half a
/// decade, for two ticks.
void PlotAxis::widen() {
  constexpr double rounding = 1e-9, part = 0.06, least_decades = 0.5;
  const double size = std::max(std::abs(low_), std::abs(high_)), width = high_ - low_;
  double margin = part * width;
  if (is_log_)
    margin = std::max(margin, (least_decades - width) / 2);
  else if (!(width > std::max(rounding * size, smallest_drawn)))
    margin = std::max(1.0, size) / 2;
  low_ -= margin;
  high_ += margin;
}

bool PlotAxis::can_draw(double value, bool is_log) {
  return std::abs(value) <= largest_drawn && (!is_log || value >= smallest_drawn);
}

double PlotAxis::scaled(double value) const { return is_log_ ? std::log10(value) : value; }

double PlotAxis::position(double value) const {
  return begin_ + (end_ - begin_) * (scaled(value) - low_) / (high_ - low_);
}

double PlotAxis::per_unit() const { return std::abs(end_ - begin_) / (high_ - low_); }

/// Labels decades, every second or third one if there are many; in less than two decades 2 and 5 too.
void PlotAxis::make_log_ticks() {
  const int first = static_cast<int>(std::floor(low_)), last = static_cast<int>(std::ceil(high_));
  const double decades = high_ - low_;
  const int stride = 1 + static_cast<int>(decades / 9);
  for (int d = first; d <= last; ++d)
    for (int m = 1; m < 10; ++m) {
      const double place = d + std::log10(m);
      if (place < low_ || place > high_ || (m > 1 && decades > 7)) continue;
      const bool labelled = (m == 1 && d % stride == 0) || ((m == 2 || m == 5) && decades < 2) || decades < 0.7;
      ticks_.push_back({m * std::pow(10.0, d), labelled ? log_label(m, d) : ""});
    }
}

/// Makes about six ticks. They are counted, because a step may be lost when it is added to a large value. Labels have
/// enough digits to distinguish them.
void PlotAxis::make_linear_ticks() {
  const double rough = (high_ - low_) / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10);
  const double largest = std::max(std::abs(low_), std::abs(high_));
  const int digits = std::clamp(2 + static_cast<int>(std::log10(largest / step)), 6, 15);
  const double first = std::ceil(low_ / step);
  const int count = 1 + static_cast<int>(std::floor(high_ / step) - first);
  for (int k = 0; k < count; ++k) {
    const double value = (first + k) * step;
    ticks_.push_back({value, fmt::format("{:.{}g}", value, digits)});
  }
}

}  // namespace plastron::io
