// Rigid bodies whose distance has a closed form.
#pragma once
#include <plastron/obstacle/nearest.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::obstacle {

/// A rigid half-space { (X - point) . normal <= 0 }: the obstacle of the paper for point 0, normal e_3.
struct HalfSpace {
  Vector3d point = Vector3d::Zero();    ///< a point of the boundary plane [m]
  Vector3d normal = Vector3d::UnitZ();  ///< unit vector towards the free side

  Nearest nearest(const Vector3d& X) const { return {(X - point).dot(normal), normal, Matrix3d::Zero()}; }
  std::optional<Extent> extent() const { return {}; }
};

/// A rigid ball, or the complement of a ball (a bowl that contains the shell).
struct Ball {
  Vector3d centre = Vector3d::Zero();  ///< [m]
  double radius = 1;                   ///< > 0 [m]
  bool inside = false;                 ///< the shell is inside: the free side is the ball

  /// Returns distance and derivatives. The distance is not differentiable at the centre; there the normal is e_3.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const;
};

/// A rigid box with rounded edges and corners.
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

/// A rigid cylinder, infinite or with plane caps and rounded edges, or the complement of a cylinder (a tube that contains
/// the shell).
struct Cylinder {
  /// Point of the axis, its middle if the length is finite [m].
  Vector3d point = Vector3d::Zero();
  Vector3d axis = Vector3d::UnitZ();                        ///< unit vector
  double radius = 1;                                        ///< > 0 [m]
  double length = std::numeric_limits<double>::infinity();  ///< > 0 [m]
  bool inside = false;                                      ///< the shell is inside: the free side is the cylinder
  double fillet = 0;  ///< radius of the rounded edges of the caps, at most radius and length / 2 [m]

  /// The body contains all points within `fillet` of a sharp cylinder: d = (distance to the sharp one) - fillet, also
  /// inside. On the axis no direction is nearest, and the normal is an arbitrary one across the axis.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const {
    if (!std::isfinite(length)) return {};
    return extent_around(point, extent_margin * std::hypot(length / 2, radius));
  }
};

/// A rigid cone, infinite or with a plane base. Its tip and the edge of its base are rounded.
struct Cone {
  Vector3d apex = Vector3d::Zero();   ///< apex of the sharp cone [m]
  Vector3d axis = Vector3d::UnitZ();  ///< unit vector from the apex into the body
  /// Angle between axis and side, above 0 and below pi/2 [rad].
  double half_angle = std::numbers::pi / 4;
  /// Distance from the apex of the sharp cone to the base [m].
  double height = std::numeric_limits<double>::infinity();
  double fillet = 0;  ///< radius of the rounding, below largest_fillet() [m]

  /// Radius of the ball that touches side and base from within: h sin a / (1 + sin a).
  double largest_fillet() const;

  /// The body contains all points within `fillet` of a smaller sharp cone. On the axis inside the body no direction
  /// is nearest, and the normal is an arbitrary one of the nearest.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const {
    if (!std::isfinite(height)) return {};
    return extent_around(apex, extent_margin * height / std::cos(half_angle));
  }
};

/// A rigid torus: all points within `tube_radius` of a circle.
struct Torus {
  Vector3d centre = Vector3d::Zero();  ///< centre of the circle [m]
  Vector3d axis = Vector3d::UnitZ();   ///< unit vector normal to the circle's plane
  double radius = 1;                   ///< radius of the circle, > tube_radius [m]
  double tube_radius = 0.25;           ///< > 0 [m]

  /// The distance is not differentiable on the axis and on the circle; there the normal is an arbitrary one of the
  /// nearest.
  Nearest nearest(const Vector3d& X) const;
  std::optional<Extent> extent() const { return extent_around(centre, extent_margin * (radius + tube_radius)); }
};

}  // namespace plastron::obstacle
