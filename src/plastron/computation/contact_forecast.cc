#include <plastron/computation/contact_forecast.hpp>
#include <plastron/zones/touching_nodes.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::computation {
namespace {

constexpr double rounding = 1e-9;  ///< rounding of interpolated zones
constexpr double likely_in = 0.75, likely_out = 0.25;

std::size_t place(const algebra::Vector& v, const assembly::ContactRow& row) {
  return row.node * static_cast<std::size_t>(v.block()) + static_cast<std::size_t>(row.obstacle);
}
double at(const algebra::Vector& v, const assembly::ContactRow& row) { return v.local()[place(v, row)]; }
double& at(algebra::Vector& v, const assembly::ContactRow& row) { return v.owned()[place(v, row)]; }

bool is_expected(const ContactTrend& expected, const assembly::ContactRow& row) {
  return at(expected.touching, row) > 0.5 ? at(expected.pressure, row) > 0 : at(expected.root_of_gap, row) < 0;
}

/// Adds 1 at the nodes of cells of which some nodes are likely in contact with the obstacle (1) and others not (0).
/// Nodes without a bound (-1) are ignored.
void mark_crossed_cells(const fem::Space& space, const algebra::Vector& likely, std::size_t obstacle,
                        algebra::Vector& marks) {
  const auto block = static_cast<std::size_t>(likely.block());
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
    bool some = false, others = false;
    const auto place = [&](algebra::LocalIndex node) { return static_cast<std::size_t>(node) * block + obstacle; };
    for (const algebra::LocalIndex node : space.nodes(cell)) {
      some = some || likely.local()[place(node)] > 0;
      others = others || likely.local()[place(node)] == 0;
    }
    if (!some || !others) continue;
    for (const algebra::LocalIndex node : space.nodes(cell)) marks.local()[place(node)] += 1;
  }
}

}  // namespace

algebra::Vector continued_roots(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  algebra::Vector roots(discrete.space().layout, solution.touching.block());
  const auto block = static_cast<std::size_t>(roots.block());
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
    const zones::TouchingNodes nodes(discrete, solution, k);
    for (std::size_t i = 0; i < nodes.roots().size(); ++i) roots.local()[i * block + k] = nodes.roots()[i];
  }
  return roots;
}

algebra::Vector interpolated_zone(algebra::Vector touching, const algebra::Vector& roots) {
  for (std::size_t i = 0; i < touching.owned().size(); ++i) {
    double& part = touching.owned()[i];
    if (part > rounding && part < 1 - rounding) part = roots.owned()[i] < 0 ? likely_in : likely_out;
  }
  return touching;
}

std::vector<char> open_coordinates(const assembly::DiscreteShell& discrete, const algebra::Vector& zone) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  std::vector<char> marks(coordinates.lower.owned().size(), 0);
  bool some = false;
  for (const assembly::ContactRow& row : coordinates.rows) {
    const double part = at(zone, row);
    if (!row.binds || part < rounding || part > 1 - rounding) continue;
    const std::size_t i = coordinates.at(row.node, row.coordinate);
    marks[i] = coordinates.lower.owned()[i] != coordinates.upper.owned()[i];
    some = some || marks[i] != 0;
  }
  return some ? marks : std::vector<char>{};
}

ContactTrend contact_trend(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  ContactTrend trend{.touching = solution.touching,
                     .pressure = solution.pressure,
                     .root_of_gap = algebra::Vector(discrete.space().layout, solution.touching.block())};
  for (const assembly::ContactRow& row : discrete.coordinates.rows) {
    const auto obstacle = static_cast<std::size_t>(row.obstacle);
    const double gap = discrete.nodal_gap(obstacle, row.node, solution.y);
    at(trend.root_of_gap, row) = std::sqrt(std::max(0.0, gap - discrete.state.lift(row.node, obstacle)));
  }
  return trend;
}

ContactTrend continued(ContactTrend now, const ContactTrend& before, double ahead) {
  const auto go_on = [&](algebra::Vector& x, const algebra::Vector& from) {
    for (std::size_t i = 0; i < x.owned().size(); ++i) x.owned()[i] += ahead * (x.owned()[i] - from.owned()[i]);
  };
  go_on(now.pressure, before.pressure);
  go_on(now.root_of_gap, before.root_of_gap);
  return now;
}

algebra::Vector expected_zone(const assembly::DiscreteShell& discrete, const ContactTrend& expected) {
  const fem::Space& space = discrete.space();
  const int obstacles = expected.touching.block();
  algebra::Vector likely(space.layout, obstacles), marks(space.layout, obstacles);
  likely.fill(-1);
  for (const assembly::ContactRow& row : discrete.coordinates.rows)
    if (row.binds) at(likely, row) = is_expected(expected, row) ? 1 : 0;
  likely.update_ghosts();
  for (std::size_t k = 0; k < static_cast<std::size_t>(obstacles); ++k) mark_crossed_cells(space, likely, k, marks);
  marks.accumulate_ghosts();
  algebra::Vector zone(space.layout, obstacles);
  for (std::size_t i = 0; i < zone.owned().size(); ++i) {
    const bool is_in = likely.owned()[i] > 0, was_in = expected.touching.owned()[i] > 0.5;
    const bool is_open = marks.owned()[i] > 0 || is_in != was_in;
    zone.owned()[i] = is_open ? (is_in ? likely_in : likely_out) : (is_in ? 1 : 0);
  }
  return zone;
}

}  // namespace plastron::computation
