#include <plastron/io/plot.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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

/// Labels decades, every second or third one if there are many; in less than two decades 2 and 5 too, in short ranges all
/// but 7 and 9, which would touch 6 and 8.
void PlotAxis::make_log_ticks() {
  const int first = static_cast<int>(std::floor(low_)), last = static_cast<int>(std::ceil(high_));
  const double decades = high_ - low_;
  const int stride = 1 + static_cast<int>(decades / 9);
  for (int d = first; d <= last; ++d)
    for (int m = 1; m < 10; ++m) {
      const double place = d + std::log10(m);
      if (place < low_ || place > high_ || (m > 1 && decades > 7)) continue;
      const bool labelled =
          (m == 1 && d % stride == 0) || ((m == 2 || m == 5) && decades < 2) || (decades < 0.7 && m != 7 && m != 9);
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

namespace {

constexpr double legend_line = 24;  // px

/// The page [px]: its size, the plot area, the upper left corner of the legend.
struct Page {
  double width, height;
  double left, right, top, bottom;
  double legend_left, legend_top;
};

Page page_of(const Plot& plot, PlotLayout layout) {
  if (layout == PlotLayout::wide)
    return {.width = 920,
            .height = 500,
            .left = 106,
            .right = 590,
            .top = 48,
            .bottom = 436,
            .legend_left = 616,
            .legend_top = 56};
  constexpr double legend_top = 346, slope = 74;
  const double entries =
      legend_line * static_cast<double>(plot.series.size()) + slope * static_cast<double>(plot.slopes.size());
  return {.width = 460,
          .height = legend_top + entries,
          .left = 106,
          .right = 444,
          .top = 44,
          .bottom = 276,
          .legend_left = 106,
          .legend_top = legend_top};
}

/// A colour for light and for dark pages. People with any colour vision can distinguish these colours (Okabe and Ito).
struct Colour {
  std::string_view on_light, on_dark;
};
constexpr std::array colours{Colour{"#0072b2", "#56b4e9"}, Colour{"#d55e00", "#ff8c42"}, Colour{"#009e73", "#2fd6a3"},
                             Colour{"#a2487f", "#e69ac6"}, Colour{"#9a7500", "#f0c94a"}, Colour{"#4d4d4d", "#c8c8c8"}};

std::string style() {
  std::string text =
      "text { font: 13px system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif; fill: #24292f; }\n"
      ".title { font-size: 16px; font-weight: 600; } .tick { font-size: 12px; fill: #57606a; }\n"
      ".page { fill: #ffffff; } .frame { fill: none; stroke: #8c959f; }\n"
      ".grid { stroke: #d8dee4; } .minor { stroke: #eff2f5; } .slope { stroke: #6e7781; fill: #eff2f5; }\n"
      ".slope-label { font-size: 12px; fill: #57606a; }\n"
      ".line { fill: none; stroke-width: 2; stroke-linejoin: round; }\n"
      ".mark { stroke-width: 1.5; }\n";
  std::string dark =
      "text { fill: #e6edf3; } .tick, .slope-label { fill: #9da7b3; }\n"
      ".page { fill: #0d1117; } .frame { stroke: #6e7681; } .grid { stroke: #262d36; } .minor { stroke: #171c23; }\n"
      ".slope { stroke: #9da7b3; fill: #171c23; }\n";
  for (std::size_t i = 0; i < colours.size(); ++i) {
    text += fmt::format(".c{0} {{ stroke: {1}; }} .f{0} {{ fill: {1}; }}\n", i, colours[i].on_light);
    dark += fmt::format(".c{0} {{ stroke: {1}; }} .f{0} {{ fill: {1}; }}\n", i, colours[i].on_dark);
  }
  return fmt::format("<style>\n{}@media (prefers-color-scheme: dark) {{\n{}}}\n</style>\n", text, dark);
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

std::string marker(std::size_t series, double x, double y, bool hollow) {
  const std::size_t colour = series % colours.size();
  const std::string look = fmt::format("class=\"mark c{} {}\"", colour, hollow ? "page" : fmt::format("f{}", colour));
  switch (series % 4) {
    case 0:
      return fmt::format("<circle {} cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\"/>\n", look, x, y);
    case 1:
      return fmt::format("<rect {} x=\"{:.2f}\" y=\"{:.2f}\" width=\"7\" height=\"7\"/>\n", look, x - 3.5, y - 3.5);
    case 2:
      return fmt::format("<path {} d=\"M{:.2f} {:.2f} l4.5 8 h-9 z\"/>\n", look, x, y - 5);
    default:
      return fmt::format("<path {} d=\"M{:.2f} {:.2f} l5 5 l-5 5 l-5 -5 z\"/>\n", look, x, y - 5);
  }
}

std::string_view dashes(bool dashed) { return dashed ? " stroke-dasharray=\"6 4\"" : ""; }

class Sheet {
 public:
  Sheet(const Plot& plot, const Page& page)
      : plot_(plot),
        page_(page),
        x_(values(&Series::x), plot.x.is_log, page.left, page.right),
        y_(values(&Series::y), plot.y.is_log, page.bottom, page.top) {}

  std::string text() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
        "role=\"img\">\n<title>{2}</title>\n{3}<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
        page_.width, page_.height, escaped(plot_.title), style());
    axes();
    put("<clipPath id=\"area\"><rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\"/></clipPath>\n",
        page_.left - 6, page_.top - 6, page_.right - page_.left + 12, page_.bottom - page_.top + 12);
    put("<g clip-path=\"url(#area)\">\n");
    for (std::size_t i = 0; i < plot_.series.size(); ++i) draw(i);
    put("</g>\n");
    slopes(legend(page_.legend_top) + 12);
    put("</svg>\n");
    return std::move(svg_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(svg_), text, std::forward<Args>(args)...);
  }

  /// Returns the values of all points that can be drawn.
  std::vector<double> values(std::vector<double> Series::*coordinate) const {
    std::vector<double> all;
    for (const auto& s : plot_.series)
      for (std::size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i)
        if (can_draw(s.x[i], s.y[i])) all.push_back((s.*coordinate)[i]);
    return all;
  }
  bool can_draw(double x, double y) const {
    return PlotAxis::can_draw(x, plot_.x.is_log) && PlotAxis::can_draw(y, plot_.y.is_log);
  }

  void axes() {
    for (const Tick& t : x_.ticks()) {
      const double x = x_.position(t.value);
      put("<path class=\"{}\" d=\"M{:.2f} {:g} V{:g}\"/>\n", t.label.empty() ? "minor" : "grid", x, page_.top,
          page_.bottom);
      put("<text class=\"tick\" x=\"{:.2f}\" y=\"{:g}\" text-anchor=\"middle\">{}</text>\n", x, page_.bottom + 19,
          t.label);
    }
    for (const Tick& t : y_.ticks()) {
      const double y = y_.position(t.value);
      put("<path class=\"{}\" d=\"M{:g} {:.2f} H{:g}\"/>\n", t.label.empty() ? "minor" : "grid", page_.left, y,
          page_.right);
      put("<text class=\"tick\" x=\"{:g}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", page_.left - 8, y + 4,
          t.label);
    }
    put("<rect class=\"frame\" x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\"/>\n", page_.left, page_.top,
        page_.right - page_.left, page_.bottom - page_.top);
    put("<text class=\"title\" x=\"{:g}\" y=\"{:g}\">{}</text>\n", page_.left, page_.top - 18, escaped(plot_.title));
    put("<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"middle\">{}</text>\n", (page_.left + page_.right) / 2,
        page_.bottom + 46, escaped(plot_.x.label));
    put("<text transform=\"translate(22 {:g}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (page_.top + page_.bottom) / 2, escaped(plot_.y.label));
  }

  /// Draws triangles beside the plot with the slopes of y ~ x^exponent on its axes. Returns the lower end.
  double slopes(double y) {
    if (!plot_.x.is_log || !plot_.y.is_log) return y;
    constexpr double largest = 56;  // px
    const double steepness = y_.per_unit() / x_.per_unit();
    for (const ReferenceSlope& s : plot_.slopes) {
      const double run = std::min(largest, largest / std::abs(s.exponent * steepness));
      const double rise = s.exponent * steepness * run;
      put("<path class=\"slope\" d=\"M{:.2f} {:.2f} h{:.2f} v{:.2f} z\"/>\n", page_.legend_left, y + std::abs(rise),
          run, -rise);
      put("<text class=\"slope-label\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n", page_.legend_left + run + 8,
          y + std::abs(rise) / 2 + 4, escaped(s.label));
      y += std::abs(rise) + 18;
    }
    return y;
  }

  void draw(std::size_t number) {
    constexpr std::size_t most_marks = 2000;
    const Series& s = plot_.series[number];
    const bool with_markers = s.with_markers && (s.x.size() <= most_marks || !s.with_line);
    std::string path, marks;
    for (std::size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i) {
      if (!can_draw(s.x[i], s.y[i])) continue;
      const double x = x_.position(s.x[i]), y = y_.position(s.y[i]);
      path += fmt::format("{}{:.2f} {:.2f} ", path.empty() ? "M" : "L", x, y);
      if (with_markers) marks += marker(number, x, y, s.dashed);
    }
    if (path.empty()) return;
    if (s.with_line) put("<path class=\"line c{}\"{} d=\"{}\"/>\n", number % colours.size(), dashes(s.dashed), path);
    put("{}", marks);
  }

  /// Draws the legend. Returns the lower end.
  double legend(double y) {
    for (std::size_t i = 0; i < plot_.series.size(); ++i, y += legend_line) {
      const Series& s = plot_.series[i];
      if (s.with_line)
        put("<path class=\"line c{}\"{} d=\"M{:g} {:g} h28\"/>\n", i % colours.size(), dashes(s.dashed),
            page_.legend_left, y);
      if (s.with_markers) put("{}", marker(i, page_.legend_left + 14, y, s.dashed));
      put("<text x=\"{:g}\" y=\"{:g}\">{}</text>\n", page_.legend_left + 38, y + 4.5, escaped(s.label));
    }
    return y;
  }

  const Plot& plot_;
  const Page page_;
  PlotAxis x_, y_;
  std::string svg_;
};

}  // namespace

std::string svg_text(const Plot& plot, PlotLayout layout) { return Sheet(plot, page_of(plot, layout)).text(); }

}  // namespace plastron::io
