// Checks that loads and prescribed values are finite at the nodes and quadrature points of the sample mesh.
#include <plastron/examination/checks.hpp>
#include <plastron/fem/basis.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace plastron::examination {

namespace {

struct Points {
  std::vector<double> x, y;

  void add(const Examined& examined, const fem::Cell& cell, const std::vector<Eigen::Vector2d>& xi) {
    const std::size_t before = x.size();
    x.resize(before + xi.size());
    y.resize(x.size());
    examined.surface->positions(cell, xi, std::span(x).subspan(before), std::span(y).subspan(before));
  }
};

Points in_domain(const Examined& examined, const NamedExpression& e) {
  Points points;
  for (const fem::Cell& cell : examined.space->cells) {
    if (!e.acts_in(assembly::region_of(*examined.space->coarse, cell))) continue;
    points.add(examined, cell, examined.tables.quadrature.xi);
    points.add(examined, cell, examined.tables.nodes);
  }
  return points;
}

Points on_boundary(const Examined& examined, const std::string& name) {
  const fem::Space& space = *examined.space;
  const auto& names = space.coarse->boundaries;
  const auto boundary = static_cast<int>(std::ranges::find(names, name) - names.begin());
  auto line = fem::gauss_lobatto(space.degree + 1).points;
  std::ranges::copy(fem::gauss(space.degree + 1).points, std::back_inserter(line));
  Points points;
  for (const fem::BoundarySide& edge : space.sides) {
    if (edge.boundary != boundary) continue;
    std::vector<Eigen::Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(fem::side_point(space.shape(), edge.side, t));
    points.add(examined, space.cells[edge.cell], xi);
  }
  return points;
}

Points points_of(const Examined& examined, const NamedExpression& e) {
  if (e.point) return {{(*e.point)[0]}, {(*e.point)[1]}};
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
    std::vector<double> values(points.x.size());
    e.f.evaluate(points.x, points.y, values);
    const auto bad = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
    if (bad == values.end()) continue;
    const auto at = static_cast<std::size_t>(bad - values.begin());
    examined.add(Severity::error, "{} is {:g} at x = {:.6g}, y = {:.6g}; it must be finite everywhere it acts", e.name,
                 *bad, points.x[at], points.y[at]);
  }
}

}  // namespace plastron::examination
