// Checks whether the loads press the shell onto the obstacle where only the obstacle fixes it. The energy must not
// decrease without limit along any rigid motion W that the supports leave free and that closes no gap: l(W) <= 0.
// By Farkas' lemma this is true if and only if reactions eta >= 0 balance the loads: -l = G' eta on the free motions.
#pragma once
#include <plastron/examination/rigid_motions.hpp>

namespace plastron::examination {

enum class Hold {
  pressed,   ///< the energy grows along every such motion
  balanced,  ///< the energy is constant along some motion: the loads just do not pull the shell off, or do no work
  pulled_off
};

struct Pressing {
  Hold hold = Hold::pressed;
  RigidMotion motion = RigidMotion::Zero();  ///< unit length: the motion that is not pressed; it opens the gap
};

/// Checks the loads. `held` is an orthonormal basis of motions that the supports leave free, `forces` are nodal forces
/// and couples.
Pressing pressing(const RigidMotions& motions, const Eigen::MatrixXd& held,
                  const std::vector<assembly::NodalPoint>& points, const assembly::NodalCoordinates& coordinates,
                  std::span<const double> forces);

}  // namespace plastron::examination
