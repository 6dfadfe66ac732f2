// The gradient at a point of a box, split into what moves free unknowns and what lets go of those at bounds; and steps that stay in
// the box. Source: Dostal, Optimal quadratic programming algorithms (2009), sections 5.2 and 5.8; letters of docs/methods/mprgp.md.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/vector.hpp>

#include <vector>

namespace plastron::contact {

struct SplitGradient {
  std::vector<char> held{};  ///< at a bound: lower, upper or both
  algebra::Vector free{};    ///< phi: g where nothing is held, else 0
  algebra::Vector
      chopped{};  ///< beta: min(g, 0) at a lower bound, max(g, 0) at an upper one, 0 elsewhere and where the two are one
  double reduced_product = 0;  ///< phi~' phi: phi~ is phi cut so that a step alpha phi~ stays in the box
  double chopped_square = 0;   ///< beta' beta

  /// beta' beta <= Gamma^2 phi~' phi with Gamma = 1: more is to be had in the face than by leaving it.
  bool is_proportional() const { return chopped_square <= reduced_product; }
};

/// alpha: the fixed step length, in (0, 2/|A|]. The vectors of `split` are used again. (collective)
void split_gradient(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                    const algebra::Vector& gradient, double alpha, SplitGradient& split);

/// The largest t with x - t d in the box; infinity if no bound is in the way. (collective)
double largest_feasible_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d);

/// P(x - t d), exactly at the bounds it comes to; ghosts up to date. (collective)
algebra::Vector clamped_step(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                             const algebra::Vector& d, double t);

/// |A| of a symmetric positive semidefinite A from below, by twenty steps of the power method from arbitrary values laid out
/// like `like`; 1 for A = 0. (collective)
double largest_eigenvalue(const algebra::Operator& apply, const algebra::Vector& like);

}  // namespace plastron::contact
