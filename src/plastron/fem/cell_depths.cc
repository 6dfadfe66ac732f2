#include <plastron/algebra/assertion.hpp>
#include <plastron/fem/cell_depths.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plastron::fem {

namespace {

using Place = std::pair<int, int>;

Place operator+(const Place& a, const Place& b) { return {a.first + b.first, a.second + b.second}; }
Place operator-(const Place& a, const Place& b) { return {a.first - b.first, a.second - b.second}; }

std::vector<Place> directions(mesh::Shape shape) {
  if (shape == mesh::Shape::quadrilateral) return {{1, 0}, {0, 1}};
  return {{1, 0}, {0, 1}, {-1, 1}};
}

/// Lower bounds of a function from its values at the points of mesh::lattice().
class LatticeBound {
 public:
  LatticeBound(mesh::Shape shape, int intervals);

  /// Returns a bound of the function round point p: the value there minus half of the positive second differences through
  /// it. It holds for quadratic functions, and for kinks of straight lines.
  double at(std::size_t p, std::span<const double> values) const;

 private:
  using Line = std::array<std::size_t, 3>;  ///< three neighbours in order; the point may be any of them
  std::vector<std::vector<Line>> lines_{};  ///< lines of each point, in the directions of the lattice's sides
};

LatticeBound::LatticeBound(mesh::Shape shape, int intervals) {
  PLASTRON_ASSERT(intervals >= 2, intervals);
  const auto points = mesh::lattice(shape, intervals);
  std::map<Place, std::size_t> index;
  std::vector<Place> places;
  for (const mesh::Vector2d& xi : points) {
    places.emplace_back(std::lround(xi[0] * intervals), std::lround(xi[1] * intervals));
    index.emplace(places.back(), index.size());
  }
  for (const Place& p : places) {
    auto& lines = lines_.emplace_back();
    for (const Place& d : directions(shape))
      for (const Place& centre : {p, p + d, p - d}) {
        if (!index.contains(centre - d) || !index.contains(centre) || !index.contains(centre + d)) continue;
        lines.push_back({index.at(centre - d), index.at(centre), index.at(centre + d)});
        break;
      }
  }
}

double LatticeBound::at(std::size_t p, std::span<const double> values) const {
  double bound = values[p];
  for (const auto& [before, centre, after] : lines_[p])
    bound -= std::max(0.0, values[before] - 2 * values[centre] + values[after]) / 2;
  return bound;
}

/// A part of the reference cell of the same shape. Triangles of negative size are turned by half a turn.
struct Part {
  mesh::Vector2d corner;
  double size;
  double least = 0, bound = 0;  ///< least value at its points, and a lower bound in it
};

/// Returns n parts per side.
std::vector<Part> divided(mesh::Shape shape, const Part& whole, int n) {
  std::vector<Part> parts;
  const double size = whole.size / n;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto corner = [&](int right, int up) {
        return mesh::Vector2d(whole.corner + size * mesh::Vector2d(i + right, j + up));
      };
      if (shape == mesh::Shape::quadrilateral || i + j < n) parts.push_back({corner(0, 0), size});
      if (shape == mesh::Shape::triangle && i + j + 1 < n) parts.push_back({corner(1, 1), -size});
    }
  return parts;
}

}  // namespace

double least_in_cell(mesh::Shape shape, int intervals, double tolerance,
                     const std::function<std::vector<double>(std::span<const mesh::Vector2d>)>& values) {
  constexpr int per_part = 4, most_divisions = 48;
  constexpr double accuracy = 0.01;
  PLASTRON_ASSERT(intervals % per_part == 0, intervals);
  const LatticeBound bound(shape, per_part);
  double least = std::numeric_limits<double>::infinity();
  std::vector<Part> open;
  const auto divide = [&](const Part& whole, int n) {
    for (Part part : divided(shape, whole, n)) {
      std::vector<mesh::Vector2d> points = mesh::lattice(shape, per_part);
      for (mesh::Vector2d& xi : points) xi = part.corner + part.size * xi;
      const std::vector<double> at = values(points);
      part.least = std::ranges::min(at);
      part.bound = part.least;
      for (std::size_t p = 0; p < at.size(); ++p) part.bound = std::min(part.bound, bound.at(p, at));
      least = std::min(least, part.least);
      open.push_back(part);
    }
  };
  divide({mesh::Vector2d::Zero(), 1}, intervals / per_part);
  for (int count = 0; count < most_divisions; ++count) {
    std::erase_if(open, [&](const Part& part) {
      return !(part.bound < least - std::max(tolerance, accuracy * std::abs(least)));
    });
    if (open.empty()) break;
    // In turn the part that may hold the least value, and the one that has it: a dip along a line has many of the first kind.
    const auto next = std::ranges::min_element(open, {}, count % 2 == 0 ? &Part::bound : &Part::least);
    const Part whole = *next;
    open.erase(next);
    divide(whole, 2);
  }
  return least;
}

}  // namespace plastron::fem
