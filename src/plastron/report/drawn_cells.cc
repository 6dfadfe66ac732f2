#include <plastron/report/drawn_cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace plastron::report {

namespace {

/// A value at a place as a mean of three points.
struct Mean {
  std::array<std::size_t, 3> points;
  std::array<float, 3> weights;
};

/// Returns the mean in the triangle of the lattice that contains xi; triangles are those of the page.
Mean mean_in_cell(mesh::Shape shape, int n, const Eigen::Vector2d& xi) {
  const bool is_triangle = shape == mesh::Shape::triangle;
  const auto below = [&](double x, int most) { return std::clamp(static_cast<int>(std::floor(x)), 0, most); };
  const int i = below(n * xi[0], n - 1), j = below(n * xi[1], is_triangle ? n - 1 - i : n - 1);
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row * (n + 1) - (is_triangle ? row * (row - 1) / 2 : 0) + column);
  };
  const auto x = static_cast<float>(n * xi[0] - i), y = static_cast<float>(n * xi[1] - j);
  if (x + y <= 1 || (is_triangle && i + j + 1 >= n)) return {{at(i, j), at(i + 1, j), at(i, j + 1)}, {1 - x - y, x, y}};
  return {{at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)}, {x + y - 1, 1 - x, 1 - y}};
}

/// How far a point lies inside the reference cell; negative outside.
double depth_in_cell(mesh::Shape shape, const Eigen::Vector2d& xi) {
  if (shape == mesh::Shape::triangle) return std::min(xi.minCoeff(), 1 - xi.sum());
  return std::min(xi.minCoeff(), 1 - xi.maxCoeff());
}

/// Finds the places of points in the cells of a drawing.
class Places {
 public:
  explicit Places(const Drawing& drawing) : drawing_(drawing) {
    for (std::size_t c = 0; c < drawing.places.size(); ++c) in_first_[drawing.places[c].first].push_back(c);
  }

  /// Returns the mean that gives the value at xi of a cell of the first mesh. The cell contains `inside`, a point near xi.
  Mean operator()(std::size_t first, const Eigen::Vector2d& xi, const Eigen::Vector2d& inside) const {
    double deepest = -std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (const std::size_t c : in_first_.at(first)) {
      const double depth = depth_in_cell(drawing_.shape, in_cell(c, inside));
      if (depth <= deepest) continue;
      deepest = depth;
      best = c;
    }
    Mean mean = mean_in_cell(drawing_.shape, drawing_.subdivisions, in_cell(best, xi));
    for (std::size_t& point : mean.points)
      point += best * static_cast<std::size_t>(mesh::nodes_per_cell(drawing_.shape, drawing_.subdivisions));
    return mean;
  }

 private:
  Eigen::Vector2d in_cell(std::size_t c, const Eigen::Vector2d& xi) const {
    const DrawnPlace& place = drawing_.places[c];
    return (xi - place.corner).cwiseQuotient(place.size);
  }

  const Drawing& drawing_;
  std::map<std::size_t, std::vector<std::size_t>> in_first_{};
};

}  // namespace

DrawnCells drawn_cells(mesh::Shape shape, int degree, std::span<const std::int64_t> cells_by_level,
                       std::int64_t most_points) {
  const int levels = static_cast<int>(cells_by_level.size()) - 1;
  const auto blocks = [&](int merged) {
    double count = 0;  // cells of several sizes form a block together
    for (int level = 0; level <= levels; ++level)
      count += std::ldexp(static_cast<double>(cells_by_level[static_cast<std::size_t>(level)]),
                          -2 * std::max(0, level - levels + merged));
    return std::llround(count);
  };
  for (int n = degree; n >= 1; --n)
    if (blocks(0) * mesh::nodes_per_cell(shape, n) <= most_points) return {n, 0, levels, blocks(0)};
  for (int merged = 1; merged <= levels; ++merged)
    if (blocks(merged) * mesh::nodes_per_cell(shape, 1) <= most_points) return {1, merged, levels, blocks(merged)};
  return {};
}

std::vector<std::vector<float>> redrawn(const std::vector<std::vector<float>>& rows, const Drawing& from,
                                        const Drawing& to) {
  constexpr double towards_centre = 1e-6;  // a point on a side belongs to the cell that is drawn
  if (from == to || rows.empty()) return rows;
  const Places places(from);
  const std::vector<Eigen::Vector2d> lattice = mesh::lattice(to.shape, to.subdivisions);
  std::vector<std::vector<float>> result(rows.size());
  for (const DrawnPlace& place : to.places)
    for (const Eigen::Vector2d& at : lattice) {
      const Eigen::Vector2d near = at + towards_centre * (mesh::centre(to.shape) - at);
      const auto in_first = [&](const Eigen::Vector2d& xi) {
        return (place.corner + place.size.cwiseProduct(xi)).eval();
      };
      const Mean mean = places(place.first, in_first(at), in_first(near));
      for (std::size_t r = 0; r < rows.size(); ++r) {
        float value = 0;
        for (std::size_t k = 0; k < 3; ++k) value += mean.weights[k] * rows[r][mean.points[k]];
        result[r].push_back(value);
      }
    }
  return result;
}

}  // namespace plastron::report
