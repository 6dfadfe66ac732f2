// Unknowns for which A has a unit diagonal and the load has size 1:  x = D^{1/2} z / s.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/contact/problem.hpp>

namespace plastron::contact {

/// Returns the diagonal of A. An entry that is not positive is replaced by the largest one, or by 1 if none is
/// positive. (collective)
algebra::Vector positive_diagonal(const BoxProblem& problem);

/// Scaling with this diagonal D. s = |b - A p|_{D^{-1}} with the prescribed values p is the
/// residual before any motion, the square root of an energy. It is 1 if that residual is zero.
class ScaledUnknowns {
 public:
  /// Precondition: `problem` outlives this object. (collective)
  explicit ScaledUnknowns(const BoxProblem& problem);

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

  const BoxProblem& problem_;
  algebra::Vector root_;  ///< D^{1/2}
  double size_ = 1;       ///< s
  algebra::Vector load_{}, lower_{}, upper_{};
  mutable algebra::Vector z_, force_;  ///< scratch vectors of apply()
};

}  // namespace plastron::contact
