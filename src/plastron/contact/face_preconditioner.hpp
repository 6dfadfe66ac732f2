// One preconditioner for all faces of the box, pinned once.
#pragma once
#include <plastron/algebra/preconditioner.hpp>
#include <plastron/contact/activity.hpp>
#include <plastron/contact/settings.hpp>

#include <vector>

namespace plastron::contact {

/// M^{-1}: A^{-1} or about it on the unknowns that were free when it was pinned, the inverse diagonal on the others. Symmetric and
/// positive definite, and so is its part on any face, P M^{-1} P with P the projection on the face's free unknowns.
class FacePreconditioner {
 public:
  /// Refers to both. `diagonal` is A's, positive.
  FacePreconditioner(algebra::Preconditioner& preconditioner, const algebra::Vector& diagonal)
      : preconditioner_(preconditioner), diagonal_(diagonal) {}

  /// Solved if that went well; singular if a motion is free on `set`, or what else failed. (collective)
  Status pin(const BoxProblem& problem, const ActiveSet& set, bool detect_free_motions);
  /// z = M^{-1} r, owned values. (collective)
  void apply(const algebra::Vector& r, algebra::Vector& z) const;

 private:
  algebra::Preconditioner& preconditioner_;
  const algebra::Vector& diagonal_;
  std::vector<char> pinned_{};
  mutable algebra::Vector on_free_{};  ///< of apply()
};

}  // namespace plastron::contact
