#include <plastron/computation/zones.hpp>

#include <plastron/zones/contact_zones.hpp>

#include <algorithm>

namespace plastron::computation {

namespace {

/// Whether all nodes of some cell touch an obstacle (collective).
bool has_cell_in_contact(const Solution& solution, std::size_t obstacle) {
  const fem::Space& space = solution.discrete->space();
  const algebra::Vector& touching = solution.nodal.touching;
  const auto obstacles = static_cast<std::size_t>(touching.block());
  std::int64_t cells = 0;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    if (std::ranges::all_of(space.nodes(c), [&](algebra::LocalIndex node) {
          return touching.local()[static_cast<std::size_t>(node) * obstacles + obstacle] != 0;
        }))
      ++cells;
  return algebra::sum_over_ranks(cells, space.layout->comm) > 0;
}

/// Returns the width of strips and rings, or the radius of round zones [m].
double width_of(const solution::ContactZone& zone) {
  const double length = zone.line_length() + zone.rim_length();
  return length > 0 ? 2 * zone.area / length : 0;
}

/// Returns zones that are wider than the layer at their edges, half of the thickness. Narrower ones carry their
/// reaction like lines.
std::vector<solution::ContactZone> wide_zones(std::vector<solution::ContactZone> zones, double thickness) {
  std::erase_if(zones, [&](const solution::ContactZone& zone) { return width_of(zone) < thickness / 2; });
  return zones;
}

}  // namespace

void add_contact_zones(Result& result) {
  auto zones = zones::contact_zones(*result.solution->discrete, result.solution->nodal);
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (solution::ContactZone& zone : zones[k]) zone.reaction.move_point(result.summary.moment_point);
    result.summary.obstacles[k].zones = std::move(zones[k]);
  }
}

double edge_change(const Solution& one, const Solution& other, double least_thickness) {
  const auto zones = zones::contact_zones(*one.discrete, one.nodal);
  const auto others = zones::contact_zones(*other.discrete, other.nodal);
  double most = 0;
  for (std::size_t k = 0; k < zones.size(); ++k) {
    if (!has_cell_in_contact(one, k)) continue;
    const auto wide = wide_zones(zones[k], least_thickness);
    if (!wide.empty()) most = std::max(most, solution::relative_distance(wide, others[k]));
  }
  return most;
}

}  // namespace plastron::computation
