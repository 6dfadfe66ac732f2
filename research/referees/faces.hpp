// Tools of solvers that work on one face of the box after the other: unknowns of unit diagonal, the gradient split into
// parts for free and for active unknowns, and one preconditioner for all faces. Source: Dostal, Optimal quadratic programming
// algorithms (2009), sections 5.2 and 5.8; symbols as in docs/research/mprgp.md.
#pragma once
#include <plastron/algebra/krylov.hpp>
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/problem.hpp>

#include <vector>

namespace plastron::referees {

/// Returns the diagonal of A. An entry that is not positive is replaced by the largest one, or by 1 if none is
/// positive. (collective)
algebra::Vector positive_diagonal(const contact::BoxProblem& problem);

/// Unknowns x = D^{1/2} z / s, for which A has a unit diagonal and the load has size 1. D is this diagonal,
/// s = |b - A p|_{D^{-1}} with the prescribed values p: the residual before any motion, the square root of an energy.
/// It is 1 if that residual is zero.
class ScaledUnknowns {
 public:
  /// Precondition: `problem` outlives this object. (collective)
  explicit ScaledUnknowns(const contact::BoxProblem& problem);

  algebra::Vector unknowns(const algebra::Vector& z) const;  ///< x of z, with current ghosts
  void unknowns(const algebra::Vector& z, algebra::Vector& x) const;
  /// Returns z of x. Values at a bound of x are exactly at that bound of z. Current ghosts.
  algebra::Vector original(const algebra::Vector& x) const;
  algebra::Vector forces(const algebra::Vector& r) const;           ///< D^{-1/2} r / s: the scale of A x
  algebra::Vector original_forces(const algebra::Vector& r) const;  ///< the inverse of forces()
  void original_forces(const algebra::Vector& r, algebra::Vector& force) const;
  /// Computes y = D^{-1/2} A D^{-1/2} x.
  void apply(const algebra::Vector& x, algebra::Vector& y) const;

  const algebra::Vector& load() const { return load_; }
  const algebra::Vector& lower() const { return lower_; }
  const algebra::Vector& upper() const { return upper_; }

 private:
  void times(double power, double factor, const algebra::Vector& v, algebra::Vector& result) const;
  algebra::Vector times(double power, double factor, const algebra::Vector& v) const;

  const contact::BoxProblem& problem_;
  algebra::Vector root_;  ///< D^{1/2}
  double size_ = 1;       ///< s
  algebra::Vector load_{}, lower_{}, upper_{};
  mutable algebra::Vector z_, force_;  ///< scratch vectors of apply()
};

struct SplitGradient {
  std::vector<char> active{};  ///< at a bound: lower, upper or both
  algebra::Vector free{};      ///< phi: g where the unknown is not at a bound, else 0
  /// beta: min(g, 0) at a lower bound, max(g, 0) at an upper one, 0 elsewhere and where both bounds are equal.
  algebra::Vector chopped{};
  double reduced_product = 0;  ///< phi~' phi: phi~ is phi cut so that a step alpha phi~ stays in the box
  double chopped_square = 0;   ///< beta' beta

  /// Whether beta' beta <= Gamma^2 phi~' phi with Gamma = 1: the face then promises more decrease than leaving it.
  bool is_proportional() const { return chopped_square <= reduced_product; }
};

/// Splits the gradient. alpha is the fixed step length, in (0, 2/|A|]. The vectors of `split` are reused. (collective)
void split_gradient(const algebra::Vector& lower, const algebra::Vector& upper, const algebra::Vector& x,
                    const algebra::Vector& gradient, double alpha, SplitGradient& split);

/// Returns a lower estimate of |A| for a symmetric positive semidefinite A, by twenty steps of the power method from
/// arbitrary values with the layout of `like`; 1 for A = 0. (collective)
double largest_eigenvalue(const algebra::Operator& apply, const algebra::Vector& like);

/// M^{-1}: A^{-1} on the unknowns that one set leaves free, the inverse diagonal on the others. It is symmetric and
/// positive definite. So is its part on any face, P M^{-1} P with P the projection on the face's free unknowns.
class FacePreconditioner {
 public:
  /// Keeps references to both. `diagonal` is A's, positive.
  FacePreconditioner(algebra::Preconditioner& preconditioner, const algebra::Vector& diagonal)
      : preconditioner_(preconditioner), diagonal_(diagonal) {}

  /// Makes M^{-1} for `set`. Returns false if a motion is free there. (collective)
  bool fix(const contact::BoxProblem& problem, const contact::ActiveSet& set, bool detect_free_motions);
  /// Computes z = M^{-1} r, owned values. (collective)
  void apply(const algebra::Vector& r, algebra::Vector& z) const;

 private:
  algebra::Preconditioner& preconditioner_;
  const algebra::Vector& diagonal_;
  std::vector<char> fixed_{};
  mutable algebra::Vector on_free_{};  ///< scratch vector of apply()
};

}  // namespace plastron::referees
