// Unknowns in which A has a unit diagonal and the load the size 1:  x = D^{1/2} z / s.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/contact/problem.hpp>

namespace plastron::contact {

/// The diagonal of A, its largest entry where one is not positive, 1 if none is. (collective)
algebra::Vector positive_diagonal(const BoxProblem& problem);

/// D is that diagonal. s = |b - A p|_{D^{-1}} with the prescribed values p: the
/// residual before anything has moved, an energy norm's square root; 1 if that is zero.
class ScaledUnknowns {
 public:
  /// `problem` must outlive this. (collective)
  explicit ScaledUnknowns(const BoxProblem& problem);

  algebra::Vector unknowns(const algebra::Vector& z) const;  ///< x of z, ghosts up to date
  void unknowns(const algebra::Vector& z, algebra::Vector& x) const;
  /// z of x; what is at a bound of x is at that bound of z exactly. Ghosts up to date.
  algebra::Vector original(const algebra::Vector& x) const;
  algebra::Vector forces(const algebra::Vector& r) const;           ///< D^{-1/2} r / s: as A x scales
  algebra::Vector original_forces(const algebra::Vector& r) const;  ///< and back
  void original_forces(const algebra::Vector& r, algebra::Vector& force) const;
  /// y = D^{-1/2} A D^{-1/2} x
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
  mutable algebra::Vector z_, force_;  ///< of apply()
};

}  // namespace plastron::contact
