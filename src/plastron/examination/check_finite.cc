// Checks that loads and prescribed values are finite at the nodes and quadrature points of the sample mesh.
#include <plastron/examination/checks.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace plastron::examination {

namespace {

using Points = std::vector<geometry::Place>;

void add(const Examined& examined, const fem::Cell& cell, const std::vector<Eigen::Vector2d>& xi, Points& points) {
  std::ranges::copy(examined.surface->places(cell, xi, true), std::back_inserter(points));
}

Points in_domain(const Examined& examined, const NamedExpression& e) {
  Points points;
  for (const fem::Cell& cell : examined.space->cells) {
    if (!e.acts_in(energy::region_of(*examined.space->coarse, cell))) continue;
    add(examined, cell, examined.tables.quadrature.xi, points);
    add(examined, cell, examined.tables.nodes, points);
  }
  return points;
}

Points on_boundary(const Examined& examined, const std::string& name) {
  const fem::Space& space = *examined.space;
  const auto& names = space.coarse->boundaries;
  const auto boundary = static_cast<int>(std::ranges::find(names, name) - names.begin());
  auto line = mesh::gauss_lobatto(space.degree + 1).points;
  std::ranges::copy(mesh::gauss(space.degree + 1).points, std::back_inserter(line));
  Points points;
  for (const fem::BoundarySide& edge : space.sides) {
    if (edge.boundary != boundary) continue;
    std::vector<Eigen::Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(mesh::side_point(space.shape(), edge.side, t));
    add(examined, space.cells[edge.cell], xi, points);
  }
  return points;
}

/// The place of a point of Omega; none outside.
Points place_in(const Examined& examined, const Eigen::Vector2d& point) {
  const auto location = fem::locate(*examined.space->coarse, point);
  if (!location) return {};
  return examined.surface->places({.coarse = location->coarse}, {&location->xi, 1}, true);
}

Points points_of(const Examined& examined, const NamedExpression& e) {
  if (e.point) return place_in(examined, *e.point);
  return e.boundary.empty() ? in_domain(examined, e) : on_boundary(examined, e.boundary);
}

}  // namespace

void check_finite(Examined& examined) {
  std::map<std::pair<std::string, std::vector<std::string>>, Points> known;  // points by boundary and regions
  const auto points_at = [&](const NamedExpression& e) -> const Points& {
    const auto place = std::pair(e.boundary, e.regions);
    if (!known.contains(place)) known.emplace(place, points_of(examined, e));
    return known.at(place);
  };
  auto all = load_expressions(examined.problem);
  std::ranges::move(support_expressions(examined.problem), std::back_inserter(all));
  for (const NamedExpression& e : all) {
    const Points points = e.point ? points_of(examined, e) : points_at(e);
    std::vector<double> values(points.size());
    e.f.evaluate(points, values);
    const auto bad = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
    if (bad == values.end()) continue;
    const auto at = static_cast<std::size_t>(bad - values.begin());
    examined.add(Severity::error, "{} is {:g} at {}; it must be finite everywhere it acts", e.name, *bad,
                 examined.place({points[at].x, points[at].y}));
  }
}

}  // namespace plastron::examination
