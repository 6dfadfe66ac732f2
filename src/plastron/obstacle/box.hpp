// A rigid box with rounded edges and corners.
#pragma once
#include <plastron/obstacle/nearest.hpp>

namespace plastron::obstacle {

struct Box {
  Vector3d centre = Vector3d::Zero();    ///< [m]
  Vector3d size = Vector3d::Ones();      ///< lengths of the sides, > 0 [m]
  Matrix3d axes = Matrix3d::Identity();  ///< columns: directions of the sides, orthonormal
  double fillet = 0;                     ///< radius of the rounding, at most half of the shortest side [m]

  /// The body contains all points within `fillet` of a smaller sharp box, the core. If several faces are equally near
  /// inside, the first of them gives the normal.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const {
    const Vector3d half = extent_margin / 2 * (axes.cwiseAbs() * size);
    return Extent{centre - half, centre + half};
  }
};

}  // namespace plastron::obstacle
