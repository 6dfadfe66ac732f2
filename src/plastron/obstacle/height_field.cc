#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/height_field.hpp>
#include <plastron/obstacle/offset_surface.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plastron::obstacle {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Half the squared distance of X from the graph's point at p, with its derivatives.
struct Objective {
  double value;
  Vector2d gradient;
  Matrix2d hessian, convex_part;
};

Objective objective(const Vector3d& X, const Vector2d& p, const HeightJet& h) {
  const Vector2d across = p - X.head<2>();
  const double up = h.value - X[2];
  const Matrix2d convex = Matrix2d::Identity() + h.gradient * h.gradient.transpose();
  return {(across.squaredNorm() + up * up) / 2, across + up * h.gradient, convex + up * h.hessian, convex};
}

bool is_positive(const Matrix2d& m) { return m(0, 0) > 0 && m.determinant() > 0; }

}  // namespace

HeightField::HeightField(std::shared_ptr<const geometry::SpaceFunction> expression) : heights_(expression) {
  if (expression->depends_on(2)) throw ObstacleError("a height is an expression of X and Y, not of Z");
}

bool HeightField::covers(const Vector2d& p) const {
  const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights_);
  return !raster || (*raster)->covers(p);
}

HeightJet HeightField::height(const Vector2d& p) const {
  if (const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights_)) return (**raster)(p);
  const auto jet = (*std::get<0>(heights_))({p[0], p[1], 0});
  return {jet.value, jet.gradient.head<2>(), jet.hessian.topLeftCorner<2, 2>()};
}

double HeightField::level(const Vector3d& X) const {
  return covers(X.head<2>()) ? X[2] - height(X.head<2>()).value : std::numeric_limits<double>::quiet_NaN();
}

void HeightField::refuse(const Vector3d& X, const char* what) const {
  std::string range;
  if (const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights_))
    range = fmt::format("; the raster covers x from {:.6g} to {:.6g} and y from {:.6g} to {:.6g}", (*raster)->from()[0],
                        (*raster)->to()[0], (*raster)->from()[1], (*raster)->to()[1]);
  throw ObstacleError(fmt::format("the height field {} ({:.6g}, {:.6g}, {:.6g}) in its own coordinates{}", what, X[0],
                                  X[1], X[2], range));
}

// Newton's method where the objective is convex, else without the part of the Hessian that is not; steps are halved until they help.
Vector2d HeightField::descend(const Vector3d& X, Vector2d p) const {
  constexpr int most_steps = 100;
  Objective f = objective(X, p, height(p));
  for (int step = 0; step < most_steps && !f.gradient.isZero(0); ++step) {
    const bool newton = is_positive(f.hessian);
    const Vector2d full = -(newton ? f.hessian : f.convex_part).inverse() * f.gradient;
    bool moved = false;
    for (double share = 1; share > 1e-9 && !moved; share /= 2) {
      const Vector2d trial = p + share * full;
      if (!covers(trial) || trial == p) continue;
      const Objective next = objective(X, trial, height(trial));
      const bool descends = next.value < f.value + 1e-4 * share * f.gradient.dot(full);
      // Beyond the rounding of its value the objective falls unseen, but its gradient is still seen to.
      const bool polishes =
          newton && next.value <= f.value * (1 + 1e-14) && next.gradient.norm() < f.gradient.norm() / 2;
      if (!descends && !polishes) continue;
      p = trial;
      f = next;
      moved = true;
    }
    if (!moved) break;
  }
  const double size = (p - X.head<2>()).norm() + std::abs(X[2]) + height(p).gradient.norm() * std::abs(X[2]);
  if (!std::isfinite(f.value)) refuse(X, "is not finite near");
  if (f.gradient.norm() > 1e-6 * std::max(std::sqrt(2 * f.value), 1e-9 * (size + X.norm())))
    refuse(X, "has no nearest point, or one at the edge, for");
  return p;
}

/// The graph is sampled within the distance of the foot found, the denser the more it bends there.
bool HeightField::leave_for_nearer_sample(const Vector3d& X, Vector2d& p) const {
  const Objective found = objective(X, p, height(p));
  const double reach = std::sqrt(2 * found.value);
  double best = found.value * (1 - 1e-9), bend = 0;
  Vector2d nearer = p;
  for (const int rings : {2, 16}) {
    for (int ring = 1; ring <= rings; ++ring)
      for (int k = 0; k < 4 * (ring + 1); ++k) {
        const double turn = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / (4 * (ring + 1));
        const Vector2d at = X.head<2>() + reach * ring / rings * Vector2d(std::cos(turn), std::sin(turn));
        if (!covers(at)) continue;
        const HeightJet h = height(at);
        bend = std::max(bend, h.hessian.norm() * reach);
        if (const double value = objective(X, at, h).value; value < best) best = value, nearer = at;
      }
    constexpr double surely_convex = 0.3;
    if (bend < surely_convex || nearer != p) break;
  }
  const bool leaves = nearer != p;
  p = nearer;
  return leaves;
}

Nearest HeightField::nearest(const Vector3d& X) const {
  Vector2d p = X.head<2>();
  if (!covers(p)) refuse(X, "has no height at");
  constexpr int most_restarts = 20;
  p = descend(X, p);
  for (int restart = 0; restart < most_restarts && leave_for_nearer_sample(X, p); ++restart) p = descend(X, p);
  const HeightJet h = height(p);
  const double slope = std::sqrt(1 + h.gradient.squaredNorm());
  const Vector3d n = Vector3d(-h.gradient[0], -h.gradient[1], 1) / slope;
  const double distance = (X - Vector3d(p[0], p[1], h.value)).dot(n);
  Matrix3d bent = Matrix3d::Zero();
  bent.topLeftCorner<2, 2>() = -h.hessian;
  return {distance, n, offset_curvature(surface_curvature(n, slope, bent), distance)};
}

}  // namespace plastron::obstacle
