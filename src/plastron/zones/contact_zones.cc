#include <plastron/zones/contact_zones.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/solution/contact_faces.hpp>
#include <plastron/solution/place_order.hpp>
#include <plastron/zones/boundary_segments.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace plastron::zones {

namespace {

/// A node that touches the obstacle, with its owner's data.
struct TouchingNode {
  int zone;
  const assembly::NodalPoint& point;
  const obstacle::Gap& gap;  ///< on a fold that of the deciding node, whose normal its force has
  Vector3d place;            ///< on the undeformed face
  double pressure;
};

/// Calls visit(TouchingNode) for the owned nodes that touch an obstacle.
template <class Visit>
void for_touching_nodes(const assembly::DiscreteShell& discrete, const solution::ContactFaces& faces,
                        std::size_t obstacle, const ZoneLabels& labels, Visit&& visit) {
  const auto block = static_cast<std::size_t>(faces.touching.block());
  const auto deciding = [&](std::size_t i) {
    const constraints::Row* kink = discrete.space().kinks.find(i);
    return kink ? static_cast<std::size_t>(kink->terms.front().node) : i;
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i)
    if (!discrete.space().continuity.constrains(i) && faces.touching.local()[i * block + obstacle] != 0)
      visit(TouchingNode{labels.of_node[i], discrete.points[i], discrete.coordinates.gaps[obstacle][deciding(i)],
                         discrete.touching_place(obstacle, i), faces.pressure.local()[i * block + obstacle]});
}

using ZoneSums = Eigen::Matrix<double, 16, 1>;  // weight, nodes, force, moment, carried, carried x, weight x, peak

/// Adds up the sums of all ranks; the last entry becomes the largest of all ranks.
std::vector<ZoneSums> over_ranks(const std::vector<ZoneSums>& mine, MPI_Comm comm) {
  const std::vector<ZoneSums> all = algebra::gathered(mine, comm);
  std::vector<ZoneSums> sums(mine.size(), ZoneSums::Zero());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ZoneSums& sum = sums[i % mine.size()];
    const double peak = std::max(sum[15], all[i][15]);
    sum += all[i];
    sum[15] = peak;
  }
  return sums;
}

/// Computes all members of the zones except the area, the place of the peak and the lines.
std::vector<solution::ContactZone> zone_totals(const assembly::DiscreteShell& discrete,
                                               const solution::ContactFaces& faces, std::size_t obstacle,
                                               const ZoneLabels& labels) {
  std::vector<ZoneSums> sums(static_cast<std::size_t>(labels.count), ZoneSums::Zero());
  for_touching_nodes(discrete, faces, obstacle, labels, [&](const TouchingNode& n) {
    const double weight = n.point.side_weight, force = n.pressure * weight;
    ZoneSums& s = sums[static_cast<std::size_t>(n.zone)];
    s[0] += weight;
    s[1] += 1;
    s.segment<3>(2) += force * n.gap.normal;
    s.segment<3>(5) += force * n.gap.contact_point.cross(n.gap.normal);
    s[8] += force;
    s.segment<3>(9) += force * n.place;
    s.segment<3>(12) += weight * n.place;
    s[15] = std::max(s[15], n.pressure);
  });
  std::vector<solution::ContactZone> zones;
  for (const ZoneSums& s : over_ranks(sums, discrete.space().layout->comm))
    zones.push_back({.nodal_area = s[0],
                     .nodes = std::llround(s[1]),
                     .reaction = {.force = s.segment<3>(2), .moment = s.segment<3>(5)},
                     .centre = s[8] > 0 ? s.segment<3>(9) / s[8] : s.segment<3>(12) / s[0],
                     .peak_pressure = s[15]});
  return zones;
}

/// Half the width of a cube about the origin that contains the shell.
double extent_of(const assembly::DiscreteShell& discrete) {
  double most = 0;
  for (const assembly::NodalPoint& p : discrete.points) most = std::max(most, p.phi.cwiseAbs().maxCoeff());
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

/// Finds the place of the peak. If several nodes share the peak up to rounding, takes the one whose place comes
/// first.
void find_peaks(const assembly::DiscreteShell& discrete, const solution::ContactFaces& faces, std::size_t obstacle,
                const ZoneLabels& labels, double size, std::vector<solution::ContactZone>& zones) {
  constexpr double same = 1 - 1e-9;
  struct Peak {
    int zone;
    Eigen::Vector2d x;
    Vector3d place;
  };
  std::vector<Peak> mine;
  for_touching_nodes(discrete, faces, obstacle, labels, [&](const TouchingNode& n) {
    if (n.pressure < same * zones[static_cast<std::size_t>(n.zone)].peak_pressure) return;
    mine.push_back({n.zone, n.point.x, n.place});
  });
  std::vector<char> found(zones.size(), 0);
  for (const auto& [zone, x, place] : algebra::gathered(mine, discrete.space().layout->comm)) {
    const auto k = static_cast<std::size_t>(zone);
    if (found[k] && solution::in_units(zones[k].peak_place, size) <= solution::in_units(place, size)) continue;
    found[k] = 1;
    zones[k].peak_x = x;
    zones[k].peak_place = place;
  }
}

std::vector<solution::ContactZone> zones_of(const assembly::DiscreteShell& discrete,
                                            const solution::NodalSolution& solution, std::size_t obstacle,
                                            double size) {
  const TouchingNodes touching(discrete, solution, obstacle);
  const ZoneLabels labels = zone_labels(discrete.space(), touching.inside());
  const solution::ContactFaces faces = solution::contact_faces(discrete, solution);
  std::vector<solution::ContactZone> zones = zone_totals(discrete, faces, obstacle, labels);
  find_peaks(discrete, faces, obstacle, labels, size, zones);
  const ZoneBoundaries boundaries = zone_boundaries(discrete, solution, obstacle, touching, labels);
  std::vector<std::vector<Segment>> segments(zones.size());
  for (const Segment& s : boundaries.segments) segments[static_cast<std::size_t>(s.zone)].push_back(s);
  for (std::size_t k = 0; k < zones.size(); ++k) {
    zones[k].lines = contact_lines(segments[k], size);
    zones[k].area = boundaries.areas[k];
  }
  std::ranges::sort(zones, {}, [&](const solution::ContactZone& zone) {
    return std::tuple(-solution::in_units(zone.area, size * size), solution::in_units(zone.centre, size));
  });
  return zones;
}

}  // namespace

std::vector<std::vector<solution::ContactZone>> contact_zones(const assembly::DiscreteShell& discrete,
                                                              const solution::NodalSolution& solution) {
  std::vector<std::vector<solution::ContactZone>> all;
  if (discrete.obstacles.empty()) return all;
  const double size = extent_of(discrete);
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) all.push_back(zones_of(discrete, solution, k, size));
  return all;
}

std::vector<double> contact_areas(const assembly::DiscreteShell& discrete, const solution::NodalSolution& solution) {
  std::vector<double> areas;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k) {
    const TouchingNodes touching(discrete, solution, k);
    const ZoneLabels labels = zone_labels(discrete.space(), touching.inside());
    const ZoneBoundaries boundaries = zone_boundaries(discrete, solution, k, touching, labels);
    areas.push_back(std::accumulate(boundaries.areas.begin(), boundaries.areas.end(), 0.0));
  }
  return areas;
}

}  // namespace plastron::zones
