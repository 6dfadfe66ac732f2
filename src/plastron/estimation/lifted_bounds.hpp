// What lifted bounds change (docs/methods/admissible.md). At a touching node the gap is the lift s and not 0. Without lifts,
// on the same active set, a functional would be J(u_h) + sum of mu s, mu the nodal reactions of its dual. The energy has also
// the quadratic part 1/2 a(d, d), d the motion of the shell back.
#pragma once
#include <plastron/estimation/derivatives.hpp>

#include <vector>

namespace plastron::estimation {

class LiftedBounds {
 public:
  /// `solved` must outlive this object (collective).
  explicit LiftedBounds(const Solved& solved);

  /// Whether some touching node has a lift, on any rank.
  bool any() const { return any_; }
  /// The dual load whose solution is the motion d back to bounds without lifts.
  DualLoad way_back() const { return {.load = none_, .fixed = back_}; }
  /// Returns the parts of the owned cells in J(without lifts) - J(u_h), to first order (collective). `multiplier`: of the
  /// functional's dual solution.
  std::vector<double> shares(const algebra::Vector& multiplier) const;

 private:
  const Solved& solved_;
  algebra::Vector none_, back_;    ///< zero; minus the part of each fixed coordinate that is due to its lift
  algebra::Vector cells_of_node_;  ///< number of cells at each local node that has bounds (block 1)
  bool any_ = false;
};

}  // namespace plastron::estimation
