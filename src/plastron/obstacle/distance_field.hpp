// The body F(X, Y, Z) <= 0 of an expression F. F need not be a distance: the distance is computed to its zero set.
#pragma once
#include <plastron/geometry/space_function.hpp>
#include <plastron/obstacle/nearest.hpp>

#include <memory>
#include <span>
#include <vector>

namespace plastron::obstacle {

class KnownDistances;

class DistanceField {
 public:
  /// Throws ObstacleError if the expression is constant.
  explicit DistanceField(std::shared_ptr<const geometry::SpaceFunction> expression);

  /// The foot Y solves F(Y) = 0, X = Y + d F'(Y) / |F'(Y)|. It is found by Newton's method, or else by a descent
  /// along the surface. Unless samples of F show that no other part of the surface is nearer, further descents start at
  /// points nearer to X where F changes its sign or is near zero. If F is a distance, one step suffices. Copies share the
  /// results, so they must not be used by several threads at once. Throws ObstacleError if the gradient of F is zero at X or at the surface, and
  /// if no foot is found.
  Nearest nearest(const Vector3d& X) const;
  /// Computes the distances of many points together, for the calls of nearest() that follow. A given function is then called
  /// for thousands of points at once. Points that need a search are left to nearest().
  void prepare(std::span<const Vector3d> X) const;
  std::optional<Extent> extent() const { return {}; }

  double level(const Vector3d& X) const { return function_->value(X); }
  std::vector<double> levels(std::span<const Vector3d> X) const { return function_->values(X); }

 private:
  std::shared_ptr<const geometry::SpaceFunction> function_;
  std::shared_ptr<KnownDistances> known_;
};

}  // namespace plastron::obstacle
