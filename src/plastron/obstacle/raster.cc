#include <plastron/geometry/text_file.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/nearest.hpp>
#include <plastron/obstacle/raster.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace plastron::obstacle {

namespace {

using geometry::TextFile;

/// Values at t in [0, 1] of the spline's four pieces or of their derivatives: d = 0, 1, 2.
std::array<double, 4> pieces(double t, int d) {
  const double s = 1 - t;
  if (d == 0)
    return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  if (d == 1) return {-s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2, t * t / 2};
  return {s, 3 * t - 2, 3 * s - 2, t};
}

/// Solves c(i-1) + 4 c(i) + c(i+1) = 6 f(i) with zero second derivatives at the ends, where therefore c = f. Adds one
/// row on each side.
Eigen::MatrixXd spline_along_rows(const Eigen::MatrixXd& f) {
  const Eigen::Index n = f.rows();
  Eigen::MatrixXd c(n + 2, f.cols());
  c.middleRows(1, n) = f;
  Eigen::VectorXd ratio = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    ratio[i] = 1 / (4 - ratio[i - 1]);
    c.row(i + 1) = (6 * f.row(i) - c.row(i)) * ratio[i];
  }
  for (Eigen::Index i = n - 2; i >= 1; --i) c.row(i + 1) -= ratio[i] * c.row(i + 2);
  c.row(0) = 2 * c.row(1) - c.row(2);
  c.row(n + 1) = 2 * c.row(n) - c.row(n - 1);
  return c;
}

struct Header {
  std::map<std::string, double> numbers;

  double wanted(const TextFile& file, const std::string& name) const {
    if (const auto found = numbers.find(name); found != numbers.end()) return found->second;
    throw ObstacleError(fmt::format("{}: the grid's head has no {}; an ESRI ASCII grid is wanted", file.path(), name));
  }
  double corner(const TextFile& file, const std::string& axis, double cell) const {
    if (const auto centre = numbers.find(axis + "llcenter"); centre != numbers.end()) return centre->second;
    return wanted(file, axis + "llcorner") + cell / 2;
  }
  std::size_t count(const TextFile& file, const std::string& name) const {
    const double n = wanted(file, name);
    if (n == std::floor(n) && n >= 2 && n <= most_raster_points) return static_cast<std::size_t>(n);
    throw ObstacleError(
        fmt::format("{}: {} is {}; a whole number from 2 to {} is wanted", file.path(), name, n, most_raster_points));
  }
};

Header read_header(TextFile& file) {
  Header header;
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  while (!file.at_end() && is_letter(file.peek().front())) {
    std::string name(file.word("a name"));
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    header.numbers[name] = file.real(("the value of " + name).c_str(), largest_coordinate);
  }
  return header;
}

Raster raster_in(TextFile& file) {
  const Header header = read_header(file);
  const std::size_t columns = header.count(file, "ncols"), rows = header.count(file, "nrows");
  if (columns * rows > most_raster_points)
    throw ObstacleError(fmt::format("{}: the grid has {} heights, at most {} are allowed", file.path(), columns * rows,
                                    most_raster_points));
  const double cell = header.wanted(file, "cellsize");
  if (!(cell > 0))
    throw ObstacleError(fmt::format("{}: cellsize is {}, but must be greater than 0", file.path(), cell));
  const auto none = header.numbers.find("nodata_value");
  Eigen::MatrixXd heights(columns, rows);
  for (std::size_t row = rows; row-- > 0;)
    for (std::size_t column = 0; column < columns; ++column) {
      const double h = file.real("a height", largest_coordinate);
      if (none != header.numbers.end() && h == none->second)
        file.refuse(
            fmt::format("column {} of row {} has no height (NODATA_value); the shell may come to stand over any: "
                        "fill the hole, or cut the grid to a rectangle without any",
                        column + 1, rows - row));
      heights(static_cast<Eigen::Index>(column), static_cast<Eigen::Index>(row)) = h;
    }
  if (!file.at_end()) file.refuse(fmt::format("more than {} x {} heights", columns, rows));
  return {heights, {header.corner(file, "x", cell), header.corner(file, "y", cell)}, cell};
}

}  // namespace

Raster::Raster(const Eigen::MatrixXd& heights, const Eigen::Vector2d& from, double cell) : from_(from), cell_(cell) {
  if (heights.rows() < 2 || heights.cols() < 2 || !heights.allFinite() || !(cell > 0))
    throw ObstacleError("a raster wants at least 2 x 2 finite heights and cells with a size");
  to_ = from_ + cell_ * Eigen::Vector2d(heights.rows() - 1, heights.cols() - 1);
  coefficients_ = spline_along_rows(spline_along_rows(heights).transpose()).transpose();
}

HeightJet Raster::operator()(const Eigen::Vector2d& p) const {
  std::array<Eigen::Index, 2> first{};
  std::array<std::array<std::array<double, 4>, 3>, 2> b{};
  for (int a = 0; a < 2; ++a) {
    const double at = (p[a] - from_[a]) / cell_;
    const Eigen::Index last = (a == 0 ? coefficients_.rows() : coefficients_.cols()) - 4;
    first[a] = std::clamp(static_cast<Eigen::Index>(std::floor(at)), Eigen::Index{0}, last);
    for (int d = 0; d < 3; ++d) b[a][d] = pieces(at - static_cast<double>(first[a]), d);
  }
  const auto sum = [&](int dx, int dy) {
    double total = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) total += b[0][dx][i] * b[1][dy][j] * coefficients_(first[0] + i, first[1] + j);
    return total;
  };
  HeightJet jet{.value = sum(0, 0), .gradient = Eigen::Vector2d(sum(1, 0), sum(0, 1)) / cell_};
  const double mixed = sum(1, 1);
  jet.hessian << sum(2, 0), mixed, mixed, sum(0, 2);
  jet.hessian /= cell_ * cell_;
  return jet;
}

Raster read_raster(const std::string& path) {
  try {
    TextFile file(path, "file", geometry::Lines::run_on);
    return raster_in(file);
  } catch (const geometry::FileError& error) {
    throw ObstacleError(error.what());
  }
}

}  // namespace plastron::obstacle
