// The gradient at a point of a box, split into a part for free unknowns and a part that releases unknowns at bounds;
// and steps that stay in the box. Source: Dostal, Optimal quadratic programming algorithms (2009), sections 5.2 and
// 5.8; symbols as in docs/methods/mprgp.md.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/vector.hpp>

#include <vector>

namespace plastron::contact {

struct SplitGradient {
  std::vector<char> held{};  ///< at a bound: lower, upper or both
  algebra::Vector free{};    ///< phi: g where the unknown is not at a bound, else 0
  algebra::Vector
      /// beta: min(g, 0) at a lower bound, max(g, 0) at an upper one, 0 elsewhere and where both bounds are equal.
      chopped{};
  double reduced_product = 0;  ///< phi~' phi: phi~ is phi cut so that a step alpha phi~ stays in the box
  double chopped_square = 0;   ///< beta' beta

  /// Whether beta' beta <= Gamma^2 phi~' phi with Gamma = 1: the face then promises more decrease than leaving it.
  bool is_proportional() const { return chopped_square <= reduced_product; }
};

/// Splits the gradient. alpha is the fixed step length, in (0, 2/|A|]. The vectors of `split` are reused. (collective)
void split_gradient(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                    const algebra::Vector& gradient, double alpha, SplitGradient& split);

/// Returns the largest t with x - t d in the box; infinity if no bound limits it. (collective)
double largest_feasible_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d);

/// Returns P(x - t d), exactly at the bounds that it reaches, with current ghosts. (collective)
algebra::Vector clamped_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d, double t);

/// Returns a lower estimate of |A| for a symmetric positive semidefinite A, by twenty steps of the power method from
/// arbitrary values with the layout of `like`; 1 for A = 0. (collective)
double largest_eigenvalue(const algebra::Operator& apply, const algebra::Vector& like);

}  // namespace plastron::contact
