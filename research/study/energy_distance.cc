#include <research/study/energy_distance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

namespace {

/// Some component is prescribed, and not at zero.
bool is_moved_by_support(const assembly::NodalCoordinates& coordinates, std::size_t node) {
  for (int k = 0; k < coordinates.width; ++k)
    if (coordinates.is_prescribed(node, k) && coordinates.lower.local()[coordinates.at(node, k)] != 0) return true;
  return false;
}

}  // namespace

double rounding_norm(const computation::Solution& solution) {
  constexpr double of_nodal_values = 16 * std::numeric_limits<double>::epsilon();  // they passed a few sums
  // The solver's tolerance is relative to what it starts from: prescribed motions at the supports, nothing elsewhere.
  constexpr double of_prescribed_motion = 1e-12;
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const auto& layout = *discrete.space().layout;
  double area = 0, displacement = 0, rotation = 0, shear = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.owned); ++i) {
    const assembly::Vector6 y = assembly::node_values(solution.nodal.y, i);
    const assembly::NodalPoint& p = discrete.points[i];
    const double error = is_moved_by_support(discrete.coordinates, i) ? of_prescribed_motion : of_nodal_values;
    const double u = y[0] * y[0] + y[1] * y[1] + y[2] * y[2], r = y[3] * y[3] + y[4] * y[4] + y[5] * y[5];
    const double weight = error * error * p.weight * p.young * p.thickness;
    area += p.weight;
    displacement += weight * u;
    rotation += weight * p.thickness * p.thickness * r;
    shear += weight * r;
  }
  area = algebra::sum_over_ranks(area, layout.comm);
  const double degree = discrete.space().degree;
  const double spacing_squared = area / (static_cast<double>(discrete.space().global_cells) * degree * degree);
  const double strains = algebra::sum_over_ranks((displacement + rotation) / spacing_squared + shear, layout.comm);
  return std::sqrt(strains);
}

double relative_noise(const computation::Solution& solution, double energy_norm) {
  const double rounding = rounding_norm(solution);
  if (!(energy_norm > 0)) return std::numeric_limits<double>::infinity();
  return std::max(solver_noise, rounding / energy_norm);
}

double relative_distance(const assembly::ShellOperator& shell, algebra::Vector y, const algebra::Vector& reference) {
  const double scale = shell.energies(reference).total();
  for (std::size_t i = 0; i < y.local().size(); ++i) y.local()[i] -= reference.local()[i];
  const double difference = shell.energies(y).total();
  return scale > 0 ? std::sqrt(difference / scale) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace plastron::study
