// The surface F = 0 of an expression F: finds points on it, and on it a local minimum of the distance from X.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <optional>

namespace plastron::obstacle {

class ZeroSet {
 public:
  /// Keeps a reference: `function` must outlive this object.
  explicit ZeroSet(const geometry::SpaceFunction& function) : function_(function) {}

  /// An approximate foot Y of X, with its error: distance off the surface and off the line through X along F' [m].
  struct Foot {
    Vector3d Y;
    geometry::SpaceJet f;
    double off;

    /// Whether Y is a foot up to rounding of X and of F. Terms of F may be as large as its second derivatives
    /// suggest.
    bool is_found(const Vector3d& X) const {
      const double bend = f.hessian.norm(), radius = bend > 0 ? f.gradient.norm() / bend : 0;
      return off <= 1e-9 * (X - Y).norm() + 1e-12 * X.norm() + 1e-14 * radius;
    }
  };

  /// Newton's method for Y + t F'(Y) = X, F(Y) = 0 from Y, with steps to the linearised surface where it fails. It
  /// may not find a foot. Precondition: F and its derivatives are finite at Y, and F' is not zero.
  Foot newton(const Vector3d& X, Vector3d Y) const;

  /// Returns the foot found by a descent of |X - Y| along the surface from Y on it: nearer than Y, and no saddle.
  Foot descend(const Vector3d& X, Vector3d Y) const;

  /// Returns the point next to Y along F' with F = 0 up to `off` [m], if there is one.
  std::optional<Vector3d> projected(Vector3d Y, double off) const;

  /// Returns a zero of F between X and a point where F has the other sign.
  Vector3d crossing(const Vector3d& X, const Vector3d& other) const;

 private:
  Vector3d downhill(const Vector3d& X, const Vector3d& Y) const;

  const geometry::SpaceFunction& function_;
};

}  // namespace plastron::obstacle
