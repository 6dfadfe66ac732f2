// The surface F = 0 of an expression F: finds points on it, and on it a local minimum of the distance from X.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace plastron::obstacle {

/// Directions to the faces, edges and corners of a cube.
const std::array<Vector3d, 26>& directions_around();

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
    bool is_found(const Vector3d& X) const { return off <= rounding(X); }
    /// Rounding of a foot [m].
    double rounding(const Vector3d& X) const {
      const double bend = f.hessian.norm(), radius = bend > 0 ? f.gradient.norm() / bend : 0;
      return 1e-9 * (X - Y).norm() + 1e-12 * X.norm() + 1e-14 * radius;
    }
    /// Whether the gradient is zero at the surface. Elsewhere, the radius of curvature is never so small a part of the distance.
    bool has_no_side(const Vector3d& X) const {
      constexpr double vanishing = 1e-8;
      return f.gradient.norm() < vanishing * f.hessian.norm() * (X - Y).norm();
    }
  };

  /// Returns the nearest points of the surface where plain Newton steps find them and samples show that no other part of the
  /// surface is nearer; nothing for the other points, which need a search. All points make their steps together, so that a given
  /// function is called for all of them at once.
  std::vector<std::optional<Foot>> sure_feet(std::span<const Vector3d> X) const;

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
  void drop_unsure(std::span<const Vector3d> X, std::span<std::optional<Foot>> feet) const;
  Vector3d downhill(const Vector3d& X, const Vector3d& Y) const;

  const geometry::SpaceFunction& function_;
};

}  // namespace plastron::obstacle
