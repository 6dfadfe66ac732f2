#include <plastron/report/load_arrows.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/io/bytes.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace plastron::report {

namespace {

/// A part of space with loads: their sum, and the loaded node next to its middle.
struct LoadedPart {
  std::array<std::int64_t, 3> number{};
  std::array<double, 3> force{}, place{}, displacement{};
  double distance = INFINITY;
};
using LoadedParts = std::map<std::array<std::int64_t, 3>, LoadedPart>;

void add(const LoadedPart& more, LoadedParts& all) {
  LoadedPart& part = all[more.number];
  const std::array<double, 3> force = part.force;
  if (more.distance < part.distance) part = more;
  for (std::size_t d = 0; d < 3; ++d) part.force[d] = force[d] + more.force[d];
}

/// Returns the loaded parts among nine along the longest side of the box round the shell, at the factors of the state. Couples
/// do not count (collective).
LoadedParts loaded_parts(const computation::Solution& solution) {
  const assembly::DiscreteShell& discrete = *solution.discrete;
  constexpr double along_longest = 9;
  const MPI_Comm comm = discrete.space().layout->comm;
  const auto owned = static_cast<std::size_t>(discrete.space().layout->owned);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < owned; ++i) box.extend(discrete.points[i].phi);
  for (double& value : box.min()) value = algebra::min_over_ranks(value, comm);
  for (double& value : box.max()) value = algebra::max_over_ranks(value, comm);
  const double longest = box.sizes().maxCoeff();
  LoadedParts mine;
  for (std::size_t i = 0; i < owned; ++i) {
    const Eigen::Vector3d& phi = discrete.points[i].phi;
    LoadedPart node{.distance = 0};
    double size = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto axis = static_cast<Eigen::Index>(d);
      for (const energy::LoadPart& load : discrete.loads)
        node.force[d] += discrete.state.factors.load(load.factor) * load.forces.local()[6 * i + d];
      size += std::abs(node.force[d]);
      const double parts = std::max(1.0, std::round(along_longest * box.sizes()[axis] / longest));
      const double at = (phi - box.min())[axis] / std::max(box.sizes()[axis], 1e-12 * longest) * parts;
      const double number = std::clamp(std::floor(at), 0.0, parts - 1);
      node.number[d] = static_cast<std::int64_t>(number);
      node.distance += std::pow(at - number - 0.5, 2);
      node.place[d] = phi[axis];
      node.displacement[d] = solution.nodal.y.local()[6 * i + d];
    }
    if (size > 0) add(node, mine);
  }
  std::vector<LoadedPart> list;
  for (const auto& [number, part] : mine) list.push_back(part);
  LoadedParts all;
  for (const LoadedPart& part : algebra::gathered(list, comm)) add(part, all);
  return all;
}

}  // namespace

io::Json loads_json(const computation::Solution& solution) {
  constexpr double least = 0.02;  // of the largest
  const LoadedParts parts = loaded_parts(solution);
  const auto norm = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
  double largest = 0;
  for (const auto& [number, part] : parts) largest = std::max(largest, norm(part.force));
  std::vector<float> places, displacements, directions;
  for (const auto& [number, part] : parts) {
    const double size = norm(part.force);
    if (!(size > least * largest)) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      places.push_back(static_cast<float>(part.place[d]));
      displacements.push_back(static_cast<float>(part.displacement[d]));
      directions.push_back(static_cast<float>(part.force[d] / size));
    }
  }
  return {{"places", io::base64_of_numbers(places)},
          {"displacements", io::base64_of_numbers(displacements)},
          {"directions", io::base64_of_numbers(directions)}};
}

}  // namespace plastron::report
