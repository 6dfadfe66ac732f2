// The outer loop over linearised gaps (M16): solve, linearise at the faces that have moved, until the linearised gap is the distance of
// the deformed faces from the obstacles. Planes need none of it: their gap is linear. An
// obstacle that is left out at a node, for others are nearer, is taken in where the shell has come closer to it.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/computation/problem.hpp>

#include <optional>

namespace plastron::computation {

/// How far the linearised gaps are from the distances of the deformed faces (collective).
struct GapError {
  double at_contact = 0;  ///< largest |distance - gap| of the faces that touch [m]
  double depth = 0;       ///< the deepest that a face at a node is inside of an obstacle [m]
};
GapError gap_error(const assembly::DiscreteShell& discrete, const certificate::NodalSolution& solution);

/// Whether there is anything to linearise again for: curved obstacles, or rows that are left out and may come to matter (collective).
bool has_rows_to_meet(const assembly::DiscreteShell& discrete);

/// How far a solution is from where its gaps were linearised.
struct Nearness {
  double distance = 0;    ///< of the faces in contact from where the state has them, the largest [m]
  double depth = 0;       ///< as in GapError [m]
  double negligible = 0;  ///< what either may be [m]

  bool is_met() const { return distance <= negligible && depth <= negligible; }
};
/// (collective)
Nearness nearness(const Linearisation& settings, const assembly::DiscreteShell& discrete,
                  const certificate::NodalSolution& solution);

/// One mesh's loop. A step moves the state by all of the way to the solution; where the distance to it does not fall, by half of the way
/// before, so that the loop ends or says that it does not.
class Relinearisation {
 public:
  Relinearisation(const Linearisation& settings, const assembly::DiscreteShell& discrete);

  /// Where to linearise next; nothing where the loop is at its end (collective).
  std::optional<assembly::State> next(const certificate::NodalSolution& solution);
  /// The last solution lies where its gaps were linearised, or needs not.
  bool is_met() const { return is_met_; }
  int steps() const { return steps_; }

 private:
  const Linearisation& settings_;
  const assembly::DiscreteShell& discrete_;
  bool is_met_ = true;
  int steps_ = 1;
  double part_ = 1, last_ = 0;
};

}  // namespace plastron::computation
