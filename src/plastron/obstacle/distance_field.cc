#include <plastron/geometry/quotation.hpp>
#include <plastron/obstacle/distance_field.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/offset_surface.hpp>

#include <fmt/format.h>

#include <cmath>

namespace plastron::obstacle {

namespace {

using geometry::SpaceJet;

/// How far Y is from being the foot of X: off the surface, and off the line through X along the gradient. Lengths.
double residual(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const double size = f.gradient.norm();
  const Vector3d n = f.gradient / size, way = X - Y;
  return std::hypot(f.value / size, (way - way.dot(n) * n).norm());
}

/// Newton's step for Y + t F'(Y) = X, F(Y) = 0.
Vector3d newton_step(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const double t = (X - Y).dot(f.gradient) / f.gradient.squaredNorm();
  const double scale = 1 / f.gradient.norm();  // of the last row and column
  Eigen::Matrix4d system = Eigen::Matrix4d::Zero();
  system.topLeftCorner<3, 3>() = Matrix3d::Identity() + t * f.hessian;
  system.topRightCorner<3, 1>() = scale * f.gradient;
  system.bottomLeftCorner<1, 3>() = scale * f.gradient.transpose();
  Eigen::Vector4d right;
  right << X - Y - t * f.gradient, -scale * f.value;
  return system.partialPivLu().solve(right).head<3>();
}

/// To the point of the linearised surface that is nearest to X.
Vector3d tangent_step(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const Vector3d way = X - Y;
  return way - f.gradient * ((f.value + f.gradient.dot(way)) / f.gradient.squaredNorm());
}

}  // namespace

DistanceField::DistanceField(std::shared_ptr<const geometry::SpaceFunction> expression)
    : function_(std::move(expression)) {
  if (!function_->depends_on(0) && !function_->depends_on(1) && !function_->depends_on(2))
    throw ObstacleError("the expression is the same everywhere: its gradient is zero");
}

void DistanceField::refuse(const Vector3d& X, const char* what) const {
  throw ObstacleError(fmt::format("the distance expression \"{}\" {} ({:.6g}, {:.6g}, {:.6g}) in its own coordinates",
                                  geometry::shortened(function_->text()), what, X[0], X[1], X[2]));
}

Vector3d DistanceField::foot(const Vector3d& X, Vector3d Y) const {
  constexpr int most_steps = 100;
  SpaceJet f = (*function_)(Y);
  const double first_size = f.gradient.norm(), rounding = 1e-15 * (X.norm() + (X - Y).norm());
  if (!std::isfinite(f.value) || !f.hessian.allFinite()) refuse(Y, "is not finite at");
  if (!(first_size > 0)) refuse(Y, "has a zero gradient at");
  double off = residual(X, Y, f);
  for (int step = 0; step < most_steps && off > 0; ++step) {
    const Vector3d newton = newton_step(X, Y, f), tangent = tangent_step(X, Y, f);
    Vector3d next = Y;
    SpaceJet there = f;
    double then = off;
    for (const Vector3d& way :
         {newton, tangent, Vector3d(tangent / 2), Vector3d(tangent / 8), Vector3d(tangent / 64)}) {
      const Vector3d trial = Y + way;
      const SpaceJet at = (*function_)(trial);
      const double size = at.gradient.norm();
      if (!(size > 0) || !at.hessian.allFinite()) continue;
      if (const double r = residual(X, trial, at); r < then) {
        then = r, next = trial, there = at;
        if (r < off / 2) break;
      }
    }
    if (!(then < off)) break;
    const bool stays = (next - Y).norm() <= rounding;
    Y = next, f = there, off = then;
    if (stays) break;
  }
  constexpr double vanishing = 1e-5;
  if (f.gradient.norm() < vanishing * first_size) refuse(Y, "has a zero gradient where it is zero, near");
  if (off > 1e-9 * ((X - Y).norm() + 1e-3 * X.norm())) refuse(X, "leads to no nearest point of the body from");
  return Y;
}

/// True with a point to begin at, if F has another sign at a point nearer to X than `distance`.
bool DistanceField::leave_for_nearer_side(const Vector3d& X, double distance, Vector3d& start) const {
  const double at_X = function_->value(X);
  for (const double share : {0.4, 0.7, 0.95})
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          if (i == 0 && j == 0 && k == 0) continue;
          start = X + share * distance * Vector3d(i, j, k).normalized();
          if (function_->value(start) * at_X < 0) return true;
        }
  return false;
}

Nearest DistanceField::nearest(const Vector3d& X) const {
  Vector3d Y = foot(X, X), start = X;
  constexpr int most_restarts = 10;
  for (int restart = 0; restart < most_restarts && leave_for_nearer_side(X, (X - Y).norm(), start); ++restart) {
    const Vector3d other = foot(X, start);
    if (!((other - X).norm() < (Y - X).norm())) break;
    Y = other;
  }
  const SpaceJet f = (*function_)(Y);
  const double size = f.gradient.norm();
  const Vector3d n = f.gradient / size;
  const double distance = (X - Y).dot(n);
  return {distance, n, offset_curvature(surface_curvature(n, size, f.hessian), distance)};
}

}  // namespace plastron::obstacle
