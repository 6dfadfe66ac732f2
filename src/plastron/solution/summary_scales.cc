// Scales of numbers that vanish. The front program names them, so they do not need the solver.
#include <plastron/solution/summary.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::solution {

Wrench Summary::foundation_reaction() const {
  Wrench sum;
  for (const FoundationReaction& foundation : foundations) sum += foundation.reaction;
  return sum;
}

double Summary::contact_norms() const {
  double sum = 0;
  for (const ObstacleContact& obstacle : obstacles) sum += obstacle.force_norms;
  return sum;
}

double Summary::force_scale() const { return std::max({load_norms, contact_norms(), support_norms}); }

double Summary::least_strain() const {
  if (!(area_modulus > 0)) return 0;
  constexpr double small = 1e-3;  // part of the energy of initial strains
  return std::max(force_scale() / area_modulus,
                  std::sqrt(2 * small * initial_energy / (area_modulus * least_thickness)));
}

double Summary::least_energy() const { return area_modulus * least_thickness * std::pow(least_strain(), 2) / 2; }

}  // namespace plastron::solution
