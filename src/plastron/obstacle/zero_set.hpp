// The surface F = 0 of an expression F: a way onto it, and along it to a point where the distance from X is
// least around.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <optional>

namespace plastron::obstacle {

class ZeroSet {
 public:
  /// `function` must outlive this.
  explicit ZeroSet(const geometry::SpaceFunction& function) : function_(function) {}

  /// A foot Y of X and how far it is from being one: off the surface, and off the line through X along F' [m].
  struct Foot {
    Vector3d Y;
    geometry::SpaceJet f;
    double off;

    /// Up to rounding: that of X, and that of F, which terms as great as its second derivatives make may have.
    bool is_found(const Vector3d& X) const {
      const double bend = f.hessian.norm(), radius = bend > 0 ? f.gradient.norm() / bend : 0;
      return off <= 1e-9 * (X - Y).norm() + 1e-12 * X.norm() + 1e-14 * radius;
    }
  };

  /// Newton's method for Y + t F'(Y) = X, F(Y) = 0 from Y, with steps to the linearised surface where it does not help.
  /// It need not find a foot. F and its derivatives are finite at Y, F' is not zero.
  Foot newton(const Vector3d& X, Vector3d Y) const;

  /// The foot of a descent of |X - Y| along the surface from Y on it: nearer than Y, and no saddle.
  Foot descend(const Vector3d& X, Vector3d Y) const;

  /// The point next to Y along F', if there is one: F = 0 up to `off` [m].
  std::optional<Vector3d> projected(Vector3d Y, double off) const;

  /// Between X and a point where F has the other sign.
  Vector3d crossing(const Vector3d& X, const Vector3d& other) const;

 private:
  Vector3d downhill(const Vector3d& X, const Vector3d& Y) const;

  const geometry::SpaceFunction& function_;
};

}  // namespace plastron::obstacle
