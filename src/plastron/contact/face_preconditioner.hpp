// One preconditioner for all faces of the box, pinned once.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/settings.hpp>

#include <vector>

namespace plastron::contact {

/// M^{-1}: (nearly) A^{-1} on the unknowns that were free when it was pinned, the inverse diagonal on the others. It is
/// symmetric and positive definite. So is its part on any face, P M^{-1} P with P the projection on the face's free
/// unknowns.
class FacePreconditioner {
 public:
  /// Keeps references to both. `diagonal` is A's, positive.
  FacePreconditioner(algebra::Preconditioner& preconditioner, const algebra::Vector& diagonal)
      : preconditioner_(preconditioner), diagonal_(diagonal) {}

  /// Returns solved if pinning succeeded, singular if a motion is free on `set`, or another failure. (collective)
  Status pin(const BoxProblem& problem, const ActiveSet& set, bool detect_free_motions);
  /// Computes z = M^{-1} r, owned values. (collective)
  void apply(const algebra::Vector& r, algebra::Vector& z) const;

 private:
  algebra::Preconditioner& preconditioner_;
  const algebra::Vector& diagonal_;
  std::vector<char> pinned_{};
  mutable algebra::Vector on_free_{};  ///< scratch vector of apply()
};

}  // namespace plastron::contact
