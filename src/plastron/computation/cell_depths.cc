#include <plastron/algebra/assertion.hpp>
#include <plastron/computation/cell_depths.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plastron::computation {

namespace {

using Place = std::pair<int, int>;

Place operator+(const Place& a, const Place& b) { return {a.first + b.first, a.second + b.second}; }
Place operator-(const Place& a, const Place& b) { return {a.first - b.first, a.second - b.second}; }

std::vector<Place> directions(mesh::Shape shape) {
  if (shape == mesh::Shape::quadrilateral) return {{1, 0}, {0, 1}};
  return {{1, 0}, {0, 1}, {-1, 1}};
}

}  // namespace

LatticeBound::LatticeBound(mesh::Shape shape, int intervals) {
  PLASTRON_ASSERT(intervals >= 2, intervals);
  const auto points = mesh::lattice(shape, intervals);
  std::map<Place, std::size_t> index;
  std::vector<Place> places;
  for (const fem::Vector2d& xi : points) {
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
    bound -= std::max(values[before] - 2 * values[centre] + values[after], 0.0) / 8;
  return bound;
}

}  // namespace plastron::computation
