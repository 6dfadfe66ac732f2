// Plots as SVG: well-formed, complete, and with all points inside the frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/io/plot.hpp>
#include <plastron/io/result_plots.hpp>

#include <cmath>
#include <set>
#include <string>

namespace plastron::io {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> labels(const PlotAxis& axis) {
  std::vector<std::string> all;
  for (const Tick& t : axis.ticks())
    if (!t.label.empty()) all.push_back(t.label);
  return all;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

io::Plot two_series() {
  return {.title = "Error < 1 & falling",
          .x = {"h [m]", true},
          .y = {"error", true},
          .series = {{"energy", {0.1, 0.2, 0.4}, {1e-4, 1e-3, 1e-2}}, {"L2", {0.1, 0.2, 0.4}, {NAN, 0, 1e-3}, true}},
          .slopes = {{2, "slope 2"}}};
}

TEST(PlotAxis, puts_equal_ratios_at_equal_distances_when_it_is_logarithmic) {
  const PlotAxis axis({1e-3, 1e1}, true, 0, 100);
  EXPECT_NEAR(axis.position(1e-2) - axis.position(1e-3), axis.position(1) - axis.position(0.1), 1e-12);
  EXPECT_NEAR(axis.per_unit(), axis.position(1) - axis.position(0.1), 1e-12);
  EXPECT_FALSE(axis.can_draw(0));
  EXPECT_FALSE(axis.can_draw(-1));
  EXPECT_FALSE(axis.can_draw(NAN));
  EXPECT_THAT(labels(axis), testing::ElementsAre("0.001", "0.01", "0.1", "1", "10"));
}

TEST(PlotAxis, labels_small_decades_as_powers_and_short_ranges_densely) {
  EXPECT_THAT(labels(PlotAxis({1e-7, 1e-4}, true, 0, 1)), testing::Contains("10⁻⁶"));
  EXPECT_GE(labels(PlotAxis({0.1, 0.4}, true, 0, 1)).size(), 2u);
  EXPECT_LE(labels(PlotAxis({1e-30, 1}, true, 0, 1)).size(), 12u);
  // 7000 would touch 6000, and 9000 the next decade.
  EXPECT_THAT(labels(PlotAxis({6000, 9000}, true, 0, 1)), testing::ElementsAre("5000", "6000", "8000", "10⁴"));
}

TEST(ResultPlots, have_no_force_of_supports_that_is_rounding) {
  const auto plots_of = [](double force) {
    Json results{{"levels", Json::array()}, {"contact", nullptr}, {"history", Json::array()}};
    results["history"].push_back(
        {{"time", 1.0}, {"energy", 70.0}, {"max_displacement", 0.5}, {"support_force", {0.0, 0.0, force}}});
    return result_plots(results).size();
  };
  EXPECT_EQ(plots_of(1e-12), 0u);
  EXPECT_EQ(plots_of(100), 1u);
}

TEST(PlotAxis, holds_all_values_and_survives_none_or_one) {
  for (const bool is_log : {true, false})
    for (const std::vector<double>& values :
         {std::vector<double>{}, std::vector<double>{3}, std::vector<double>{0}, std::vector<double>{-5, 7, 2}}) {
      const PlotAxis axis(values, is_log, 10, 20);
      for (const double v : values) {
        if (!axis.can_draw(v)) continue;
        EXPECT_GE(axis.position(v), 10);
        EXPECT_LE(axis.position(v), 20);
      }
      EXPECT_FALSE(axis.ticks().empty());
    }
}

TEST(PlotAxis, has_few_ticks_with_labels_of_their_own_however_near_or_far_its_values_are) {
  const std::vector<std::vector<double>> ranges{{1, 1 + 2.3e-16}, {210000000000.5, 210000000000.50003},
                                                {0, 5e-324},      {0, 1e-310},
                                                {-1e300, 1e300},  {1e300, 1e300 + 2e284},
                                                {1, 1 + 3e-9},    {1.2345678, 1.2345679},
                                                {-1e-40, 1e-41},  {1e16, 1e16 + 2, 1e16 + 4}};
  for (const bool is_log : {true, false})
    for (const std::vector<double>& values : ranges) {
      const PlotAxis axis(values, is_log, 10, 20);
      EXPECT_LE(axis.ticks().size(), is_log ? 700u : 12u) << values[0];
      EXPECT_GE(axis.ticks().size(), 2u) << values[0];
      const std::vector<std::string> all = labels(axis);
      EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size()) << values[0];
      for (const Tick& t : axis.ticks()) EXPECT_TRUE(std::isfinite(axis.position(t.value))) << values[0];
    }
}

TEST(Plot, of_many_points_is_a_line_without_marks) {
  io::Plot plot{.title = "many", .x = {"x"}, .y = {"y"}, .series = {{"y", {}, {}}}};
  for (int k = 0; k < 5000; ++k) plot.series[0].x.push_back(k), plot.series[0].y.push_back(k % 7);
  EXPECT_EQ(count(svg_text(plot), "<circle"), 1u);  // the legend's
}

TEST(Plot, is_a_whole_file_with_escaped_texts_labels_and_legend) {
  const std::string svg = svg_text(two_series());
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  EXPECT_THAT(svg, HasSubstr("Error &lt; 1 &amp; falling"));
  EXPECT_THAT(svg, HasSubstr(">h [m]<"));
  EXPECT_THAT(svg, HasSubstr(">energy<"));
  EXPECT_THAT(svg, HasSubstr(">slope 2<"));
  EXPECT_THAT(svg, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_EQ(count(svg, "<g "), count(svg, "</g>"));
  EXPECT_EQ(count(svg, "<text"), count(svg, "</text>"));
}

TEST(Plot, leaves_out_what_cannot_be_drawn) {
  const std::string svg = svg_text(two_series());
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_EQ(count(svg, "<circle"), 3u + 1u);             // three points and the legend
  EXPECT_EQ(count(svg, "<rect class=\"mark"), 1u + 1u);  // one point and the legend
}

TEST(Plot, of_nothing_is_an_empty_frame) {
  const std::string svg = svg_text({.title = "none", .x = {"x"}, .y = {"y", true}});
  EXPECT_THAT(svg, HasSubstr("class=\"frame\""));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace plastron::io
