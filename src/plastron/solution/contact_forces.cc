#include <plastron/solution/contact_forces.hpp>

#include <algorithm>
#include <tuple>

namespace plastron::solution {

namespace {

constexpr std::size_t force_entries = 14;  // obstacle, x, place, displacement, force, pressure, area

void pack_force(const ContactForce& c, std::vector<double>& all) {
  all.push_back(static_cast<double>(c.obstacle));
  all.insert(all.end(), c.x.begin(), c.x.end());
  for (const Vector3d& v : {c.place, c.displacement, c.force}) all.insert(all.end(), v.begin(), v.end());
  all.push_back(c.pressure);
  all.push_back(c.area);
}

ContactForce unpacked_force(const double* v) {
  return {.obstacle = static_cast<std::size_t>(v[0]),
          .x = {v[1], v[2]},
          .place = {v[3], v[4], v[5]},
          .displacement = {v[6], v[7], v[8]},
          .force = {v[9], v[10], v[11]},
          .pressure = v[12],
          .area = v[13]};
}

}  // namespace

std::vector<ContactForce> contact_forces(const assembly::DiscreteShell& discrete, const NodalSolution& solution) {
  std::vector<double> mine;
  for (std::size_t k = 0; k < discrete.obstacles.all.size(); ++k)
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
      if (discrete.coordinates.tied[i] || solution.touching.at(i)[k] == 0) continue;
      const assembly::NodalPoint& point = discrete.points[i];
      const obstacle::Gap& gap = discrete.coordinates.gaps[k][i];
      const double pressure = solution.pressure.at(i)[k];
      pack_force({.obstacle = k,
                  .x = point.x,
                  .place = gap.contact_point,
                  .displacement = assembly::node_values(solution.y, i).head<3>(),
                  .force = pressure * point.weight * gap.normal,
                  .pressure = pressure,
                  .area = point.weight},
                 mine);
    }
  const std::vector<double> all = algebra::gather_over_ranks(mine, discrete.space().layout->comm);
  std::vector<ContactForce> forces;
  for (std::size_t at = 0; at < all.size(); at += force_entries) forces.push_back(unpacked_force(all.data() + at));
  std::ranges::sort(forces, [](const ContactForce& a, const ContactForce& b) {
    return std::tuple(a.obstacle, a.x[0], a.x[1]) < std::tuple(b.obstacle, b.x[0], b.x[1]);
  });
  return forces;
}

}  // namespace plastron::solution
