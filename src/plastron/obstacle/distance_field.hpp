// The body F(X, Y, Z) <= 0 of an expression F. F need not be a distance: what counts is its zero set, to which the
// distance is found.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <memory>

namespace plastron::obstacle {

class DistanceField {
 public:
  /// Throws ObstacleError if the expression is the same everywhere.
  explicit DistanceField(std::shared_ptr<const geometry::SpaceFunction> expression);

  /// The foot Y solves F(Y) = 0, X = Y + d F'(Y) / |F'(Y)|: Newton's method, else a descent along the surface, and
  /// descents again from where F changes its sign nearer to X or nearly does. If F is a distance one step ends it.
  /// Throws ObstacleError where the gradient of F is zero at X or at the surface, and where no foot is found.
  Nearest nearest(const Vector3d& X) const;

  double level(const Vector3d& X) const { return function_->value(X); }

 private:
  std::shared_ptr<const geometry::SpaceFunction> function_;
};

}  // namespace plastron::obstacle
