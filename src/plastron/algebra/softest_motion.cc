#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/algebra/softest_motion.hpp>

#include <cmath>
#include <limits>

namespace plastron::algebra {
namespace {

// Computes a = D v, zero at fixed unknowns.
void weigh(const Vector& diagonal, const Vector& v, std::span<const char> fixed, Vector& a) {
  for (std::size_t i = 0; i < v.owned().size(); ++i) {
    const bool is_fixed = !fixed.empty() && fixed[i];
    a.owned()[i] = is_fixed ? 0.0 : diagonal.owned()[i] * v.owned()[i];
  }
}

}  // namespace

bool SoftestMotion::is_free() const {
  constexpr double nothing_but_rounding = 4 * std::numeric_limits<double>::epsilon();
  constexpr double unlike_its_factor = 1e-3;
  return !(stiffness > nothing_but_rounding) || !(stiffness > unlike_its_factor * factor_stiffness);
}

SoftestMotion softest_motion(const Operator& apply, const Operator& solve, std::span<const char> fixed,
                             const Vector& diagonal) {
  PLASTRON_ASSERT(fixed.empty() || fixed.size() == diagonal.owned().size(), fixed.size(), diagonal.owned().size());
  SoftestMotion softest{Vector(diagonal.layout(), diagonal.block())};
  Vector& v = softest.motion;
  Vector force(v);
  Vector weighted(v);
  fill_with_pseudo_random_values(v);
  for (int step = 0; step < 2; ++step) {
    weigh(diagonal, v, fixed, force);
    solve(force, v);
    weigh(diagonal, v, fixed, weighted);
    const double size = std::sqrt(dot(v, weighted));
    if (size == 0) return softest;
    softest.factor_stiffness = dot(v, force) / (size * size);
    for (double& value : v.owned()) value /= size;
  }
  v.update_ghosts();
  Vector Av(v.layout(), v.block());
  apply(v, Av);
  softest.stiffness = dot(v, Av);
  return softest;
}

}  // namespace plastron::algebra
