// Whether the loads press the shell onto the obstacle where only the obstacle holds it: the energy must not fall without
// bound along any rigid motion W that the supports leave free and that opens no gap by less than nothing, l(W) <= 0.
// By Farkas' lemma that is so if and only if reactions eta >= 0 balance the loads: -l = G' eta on the free motions.
#pragma once
#include <plastron/examination/rigid_motions.hpp>

namespace plastron::examination {

enum class Hold {
  pressed,   ///< the energy grows along every such motion
  balanced,  ///< along some motion it does not change: the loads just do not pull the shell off, or do no work
  pulled_off
};

struct Pressing {
  Hold hold = Hold::pressed;
  RigidMotion motion = RigidMotion::Zero();  ///< of unit length: the one that is not pressed; opens the gap
};

/// `held` is an orthonormal basis of motions that the supports leave free, `forces` the load's nodal forces and couples.
Pressing pressing(const RigidMotions& motions, const Eigen::MatrixXd& held,
                  const std::vector<assembly::NodalPoint>& points, const assembly::NodalCoordinates& coordinates,
                  std::span<const double> forces);

}  // namespace plastron::examination
