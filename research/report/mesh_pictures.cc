#include <research/report/study_report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace plastron::study {

namespace {

constexpr double page_width = 920, margin = 20, caption_height = 30, legend_height = 40;  // px
/// A picture's height over its width, at the least and at the most: longer domains are drawn shorter.
constexpr double flattest = 0.1, steepest = 2;

constexpr const char* mesh_style =
    "<style>\n"
    "text { font: 13px system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif; fill: #24292f; }\n"
    ".page { fill: #ffffff; } .cells { fill: none; stroke: #57606a; stroke-width: 0.6; stroke-linejoin: round; }\n"
    ".zone { fill: #ffd8a8; } .hanging { fill: #0072b2; }\n"
    "@media (prefers-color-scheme: dark) {\n"
    "text { fill: #e6edf3; } .page { fill: #0d1117; } .cells { stroke: #9da7b3; }\n"
    ".zone { fill: #7a4a12; } .hanging { fill: #56b4e9; }\n"
    "}\n</style>\n";

/// From Omega to a picture whose upper left corner is the origin.
class Frame {
 public:
  Frame(const Eigen::AlignedBox2d& box, double width)
      : width_(width),
        height_(width * std::clamp(box.sizes()[1] / box.sizes()[0], flattest, steepest)),
        least_(box.min()),
        scale_(width / box.sizes()[0], height_ / box.sizes()[1]) {}
  double width() const { return width_; }
  double height() const { return height_; }
  Eigen::Vector2d operator()(const Eigen::Vector2d& x) const {
    return {scale_[0] * (x[0] - least_[0]), height_ - scale_[1] * (x[1] - least_[1])};
  }

 private:
  double width_, height_;
  Eigen::Vector2d least_, scale_;
};

/// The SVG path of a closed polygon without points on the straight line between their neighbours.
std::string path_of(const Outline& outline, const Frame& frame) {
  constexpr double visible = 0.05;  // px
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& p : outline) points.push_back(frame(p));
  std::string path;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d &before = points[(i + points.size() - 1) % points.size()],
                          &after = points[(i + 1) % points.size()];
    const Eigen::Vector2d along = (after - before).normalized(), way = points[i] - before;
    if (std::abs(along[0] * way[1] - along[1] * way[0]) < visible && along.dot(way) > 0 &&
        along.dot(way) < (after - before).norm())
      continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", points[i][0], points[i][1]);
  }
  return path.empty() ? path : path + "z";
}

std::string path_of(const std::vector<Outline>& outlines, const Frame& frame) {
  std::string path;
  for (const Outline& outline : outlines) path += path_of(outline, frame);
  return path;
}

std::string group(const MeshPicture& picture, const Frame& frame, double left, double top) {
  std::string svg = fmt::format("<g transform=\"translate({:g} {:g})\">\n<text x=\"0\" y=\"-10\">{}</text>\n", left,
                                top, picture.caption);
  svg += fmt::format("<path class=\"zone\" d=\"{}\"/>\n", path_of(picture.touching, frame));
  svg += fmt::format("<path class=\"cells\" d=\"{}\"/>\n", path_of(picture.cells, frame));
  for (const Eigen::Vector2d& x : picture.hanging)
    svg += fmt::format("<circle class=\"hanging\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.5\"/>\n", frame(x)[0], frame(x)[1]);
  return svg + "</g>\n";
}

std::string legend(double top) {
  return fmt::format(
      "<g transform=\"translate({:g} {:g})\">\n<rect class=\"zone\" width=\"22\" height=\"12\" y=\"-11\"/>"
      "<text x=\"30\">contact zone</text>\n"
      "<circle class=\"hanging\" cx=\"150\" cy=\"-5\" r=\"2.5\"/><text x=\"160\">hanging vertex</text>\n</g>\n",
      margin, top);
}

}  // namespace

std::string svg_of_meshes(std::span<const MeshPicture> pictures) {
  if (pictures.empty() || pictures.front().cells.empty()) return "";
  const Eigen::AlignedBox2d box = study::box(pictures.front().cells);
  const bool is_stacked = box.sizes()[1] < 0.5 * box.sizes()[0];
  const auto count = static_cast<double>(pictures.size());
  const double columns = is_stacked ? 1 : count;
  const Frame frame(box, (page_width - margin * (columns + 1)) / columns);
  const double row = frame.height() + caption_height + margin;
  const double height = legend_height + row * (is_stacked ? count : 1);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "role=\"img\">\n<title>Meshes</title>\n{2}<rect class=\"page\" width=\"100%\" height=\"100%\"/>\n",
      page_width, height, mesh_style);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const double at = static_cast<double>(i);
    const double left = is_stacked ? margin : margin + at * (frame.width() + margin);
    svg += group(pictures[i], frame, left, caption_height + (is_stacked ? at * row : 0));
  }
  return svg + legend(height - 14) + "</svg>\n";
}

}  // namespace plastron::study
