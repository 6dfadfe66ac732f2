#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/contact/split_gradient.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::contact {
namespace {

using algebra::Vector;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

void split_gradient(const Vector& lower, const Vector& upper, const Vector& x, const Vector& gradient, double alpha,
                    SplitGradient& split) {
  split.held.assign(x.owned().size(), 0);
  for (Vector* part : {&split.free, &split.chopped}) {
    if (!part->layout()) *part = Vector(x.layout(), x.block());
    part->fill(0);
  }
  split.reduced_product = 0;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double g = gradient.owned()[i], z = x.owned()[i];
    const bool at_lower = z <= lower.owned()[i], at_upper = z >= upper.owned()[i];
    split.held[i] = at_lower || at_upper;
    if (!split.held[i]) {
      split.free.owned()[i] = g;
      const double room = (g > 0 ? z - lower.owned()[i] : upper.owned()[i] - z) / alpha;
      split.reduced_product += std::min(room, std::abs(g)) * std::abs(g);
    } else if (at_lower != at_upper) {
      split.chopped.owned()[i] = at_lower ? std::min(g, 0.0) : std::max(g, 0.0);
    }
  }
  split.reduced_product = algebra::sum_over_ranks(split.reduced_product, x.layout()->comm);
  split.chopped_square = algebra::dot(split.chopped, split.chopped);
}

double largest_feasible_step(const Vector& lower, const Vector& upper, const Vector& x, const Vector& d) {
  double largest = infinity;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double step = d.owned()[i], z = x.owned()[i];
    if (step > 0) largest = std::min(largest, (z - lower.owned()[i]) / step);
    if (step < 0) largest = std::min(largest, (z - upper.owned()[i]) / step);
  }
  return algebra::min_over_ranks(largest, x.layout()->comm);
}

Vector clamped_step(const Vector& lower, const Vector& upper, const Vector& x, const Vector& d, double t) {
  Vector result = x;
  for (std::size_t i = 0; i < x.owned().size(); ++i) {
    const double l = lower.owned()[i], u = upper.owned()[i], step = d.owned()[i];
    double& z = result.owned()[i];
    // The unknown that stops the step must be exactly at its bound in spite of rounding.
    const bool is_stopped = (step > 0 && (z - l) / step <= t) || (step < 0 && (z - u) / step <= t);
    z = is_stopped ? (step > 0 ? l : u) : std::clamp(z - t * step, l, u);
  }
  result.update_ghosts();
  return result;
}

double largest_eigenvalue(const algebra::Operator& apply, const Vector& like) {
  constexpr int steps = 20;
  Vector v(like.layout(), like.block()), Av = v;
  algebra::fill_with_pseudo_random_values(v);
  double value = 0;
  for (int step = 0; step < steps; ++step) {
    const double size = algebra::norm(v);
    if (!(size > 0)) break;
    for (double& entry : v.owned()) entry /= size;
    v.update_ghosts();
    apply(v, Av);
    value = algebra::dot(v, Av);
    v = Av;
  }
  return value > 0 ? value : 1;
}

}  // namespace plastron::contact
