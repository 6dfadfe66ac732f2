#include <plastron/study/energy_distance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::study {

double rounding_norm(const Solution& solution) {
  constexpr double epsilon = 16 * std::numeric_limits<double>::epsilon();  // of nodal values that passed a few sums
  const assembly::DiscreteShell& discrete = *solution.discrete;
  const auto& layout = *discrete.space().layout;
  double area = 0, displacement = 0, rotation = 0, shear = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.owned); ++i) {
    const double* y = solution.nodal.y.local().data() + 6 * i;
    const assembly::NodalPoint& p = discrete.points[i];
    const double u = y[0] * y[0] + y[1] * y[1] + y[2] * y[2], r = y[3] * y[3] + y[4] * y[4] + y[5] * y[5];
    area += p.weight;
    displacement += p.weight * p.thickness * u;
    rotation += p.weight * std::pow(p.thickness, 3) * r;
    shear += p.weight * p.thickness * r;
  }
  area = algebra::sum_over_ranks(area, layout.comm);
  const double degree = discrete.space().degree;
  const double spacing_squared = area / (static_cast<double>(discrete.space().global_cells) * degree * degree);
  const double strains = algebra::sum_over_ranks((displacement + rotation) / spacing_squared + shear, layout.comm);
  return epsilon * std::sqrt(discrete.shell.material().young() * strains);
}

double relative_noise(const Solution& solution, double energy_norm) {
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
