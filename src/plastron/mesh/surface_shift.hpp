// A change of the mid-surface that is given on a mesh of its own, for example an imperfection.
#pragma once
#include <plastron/geometry/jet.hpp>

#include <array>

namespace plastron::mesh {

using geometry::Vector2d;
using geometry::Vector3d;

/// The mid-surface becomes phi + u, and its unit normal a_3 becomes the director (a_3 + r) / |a_3 + r|.
class SurfaceShift {
 public:
  struct Jet {
    Vector3d u = Vector3d::Zero(), r = Vector3d::Zero();
    std::array<Vector3d, 2> du{Vector3d::Zero(), Vector3d::Zero()};  ///< along the coordinates of Omega
    std::array<Vector3d, 2> dr{Vector3d::Zero(), Vector3d::Zero()};
  };

  SurfaceShift() = default;
  SurfaceShift(const SurfaceShift&) = delete;
  SurfaceShift& operator=(const SurfaceShift&) = delete;
  virtual ~SurfaceShift() = default;

  /// Returns the change at a point of Omega (at an address on a mesh in space, address_of()). u and r are continuous. Where
  /// their derivatives jump, they are those on the side of `inside`, a point nearby. Throws DomainError where nothing is given.
  virtual Jet at(const Vector2d& point, const Vector2d& inside) const = 0;
};

}  // namespace plastron::mesh
