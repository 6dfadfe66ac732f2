#include <research/study/nearest_admissible.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cstddef>

namespace plastron::study {

namespace {

/// Cartesian again after every coordinate z of an owned node has become change(z, lower, upper).
template <class Change>
algebra::Vector changed_coordinates(const assembly::DiscreteShell& discrete, const algebra::Vector& y,
                                    Change&& change) {
  const assembly::NodalCoordinates& coordinates = discrete.coordinates;
  algebra::Vector z(y.layout(), coordinates.width), result(y.layout(), 6);
  for (std::size_t i = 0; i < static_cast<std::size_t>(y.layout()->owned); ++i) {
    if (coordinates.tied[i]) continue;
    const assembly::Vector6 at_node = coordinates.basis[i].partialPivLu().solve(assembly::node_values(y, i));
    for (int k = 0; k < coordinates.width; ++k) {
      const std::size_t at = coordinates.at(i, k);
      z.local()[at] = change(at_node[k], coordinates.lower.local()[at], coordinates.upper.local()[at]);
    }
  }
  z.update_ghosts();
  coordinates.to_cartesian(z, result);
  return result;
}

}  // namespace

algebra::Vector nearest_admissible(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  return changed_coordinates(discrete, y,
                             [](double z, double lower, double upper) { return std::clamp(z, lower, upper); });
}

algebra::Vector virtual_part(const assembly::DiscreteShell& discrete, const algebra::Vector& difference) {
  return changed_coordinates(discrete, difference,
                             [](double z, double lower, double upper) { return lower == upper ? 0.0 : z; });
}

}  // namespace plastron::study
