// The body F(X, Y, Z) <= 0 of an expression F. F need not be a distance: what counts is its zero set, to which the distance is found.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <memory>

namespace plastron::obstacle {

class DistanceField {
 public:
  /// Throws ObstacleError if the expression is the same everywhere.
  explicit DistanceField(std::shared_ptr<const geometry::SpaceFunction> expression);

  /// The foot Y solves F(Y) = 0, X = Y + d F'(Y) / |F'(Y)|: Newton's method, with projections on the tangent plane where that fails, and
  /// once more
  /// from where F changes its sign nearer to X. If F is a distance the first step ends it. Throws ObstacleError where the gradient of F
  /// is zero at X or at
  /// the surface, and where no foot is found.
  Nearest nearest(const Vector3d& X) const;

  double level(const Vector3d& X) const { return function_->value(X); }

 private:
  Vector3d foot(const Vector3d& X, Vector3d Y) const;
  bool leave_for_nearer_side(const Vector3d& X, double distance, Vector3d& start) const;
  [[noreturn]] void refuse(const Vector3d& X, const char* what) const;

  std::shared_ptr<const geometry::SpaceFunction> function_;
};

}  // namespace plastron::obstacle
