#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/obstacle/zero_set.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plastron::obstacle {

namespace {

using geometry::SpaceJet;

double residual(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const double size = f.gradient.norm();
  const Vector3d n = f.gradient / size, way = X - Y;
  return std::hypot(f.value / size, (way - way.dot(n) * n).norm());
}

bool is_usable(const SpaceJet& f) {
  return std::isfinite(f.value) && f.hessian.allFinite() && f.gradient.allFinite() && !f.gradient.isZero(0);
}

/// Newton's step for Y + t F'(Y) = X, F(Y) = 0.
Vector3d newton_step(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const double t = (X - Y).dot(f.gradient) / f.gradient.squaredNorm();
  const double scale = 1 / f.gradient.norm();  // scale of the last row and column
  Eigen::Matrix4d system = Eigen::Matrix4d::Zero();
  system.topLeftCorner<3, 3>() = Matrix3d::Identity() + t * f.hessian;
  system.topRightCorner<3, 1>() = scale * f.gradient;
  system.bottomLeftCorner<1, 3>() = scale * f.gradient.transpose();
  Eigen::Vector4d right;
  right << X - Y - t * f.gradient, -scale * f.value;
  return system.partialPivLu().solve(right).head<3>();
}

/// Step to the point of the linearised surface nearest to X.
Vector3d tangent_step(const Vector3d& X, const Vector3d& Y, const SpaceJet& f) {
  const Vector3d way = X - Y;
  return way - f.gradient * ((f.value + f.gradient.dot(way)) / f.gradient.squaredNorm());
}

}  // namespace

ZeroSet::Foot ZeroSet::newton(const Vector3d& X, Vector3d Y) const {
  constexpr int most_steps = 100;
  const double rounding = 1e-15 * (X.norm() + (X - Y).norm());
  SpaceJet f = function_(Y);
  double off = residual(X, Y, f);
  for (int step = 0; step < most_steps && off > 0; ++step) {
    const Vector3d newton = newton_step(X, Y, f), tangent = tangent_step(X, Y, f);
    Vector3d next = Y;
    SpaceJet there = f;
    double then = off;
    for (const Vector3d& way :
         {newton, tangent, Vector3d(tangent / 2), Vector3d(tangent / 8), Vector3d(tangent / 64)}) {
      const Vector3d trial = Y + way;
      const SpaceJet at = function_(trial);
      if (!is_usable(at)) continue;
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
  return {Y, f, off};
}

std::optional<Vector3d> ZeroSet::projected(Vector3d Y, double off) const {
  constexpr int most_steps = 40;
  SpaceJet f = function_(Y);
  for (int step = 0; step < most_steps && is_usable(f); ++step) {
    if (std::abs(f.value) <= off * f.gradient.norm()) return Y;
    const Vector3d full = -f.gradient * (f.value / f.gradient.squaredNorm());
    double share = 1;
    SpaceJet there = function_(Y + full);
    for (; share > 1e-3 && !(std::abs(there.value) < std::abs(f.value)); there = function_(Y + share * full))
      share /= 2;
    Y += share * full, f = there;
  }
  return {};
}

/// Step to the minimum of the quadratic model of half the squared distance on the surface, I + d S, with absolute
/// eigenvalues. It leaves saddles, also from a Y exactly on one.
Vector3d ZeroSet::downhill(const Vector3d& X, const Vector3d& Y) const {
  constexpr double least = 1e-6, is_there = 1e-6, saddle = -1e-6;
  const SpaceJet f = function_(Y);
  const double size = f.gradient.norm();
  const Vector3d n = f.gradient / size, way = X - Y, along = way - way.dot(n) * n;
  const Matrix3d model = Matrix3d::Identity() + way.dot(n) * surface_curvature(n, size, f.hessian);
  const auto eigen = geometry::symmetric_eigen(model);
  const Vector3d sizes = eigen.values.cwiseAbs().cwiseMax(least);
  Vector3d step = eigen.vectors * (eigen.vectors.transpose() * along).cwiseQuotient(sizes);
  if (along.norm() < is_there * way.norm() && eigen.values[0] < saddle) {
    const Vector3d bend = 0.1 * way.norm() * eigen.vectors.col(0);
    step = bend.dot(along) < 0 ? Vector3d(-bend) : bend;
  }
  const double longest = way.norm();
  return step.norm() > longest ? Vector3d(step * (longest / step.norm())) : step;
}

ZeroSet::Foot ZeroSet::descend(const Vector3d& X, Vector3d Y) const {
  constexpr int most_steps = 100;
  for (int step = 0; step < most_steps; ++step) {
    const Vector3d full = downhill(X, Y);
    const double before = (X - Y).norm();
    bool moved = false;
    for (double share = 1; share > 1e-6 && !moved; share /= 2) {
      const auto trial = projected(Y + share * full, 1e-10 * before);
      moved = trial && (X - *trial).norm() < before * (1 - 1e-9);
      if (moved) Y = *trial;
    }
    if (!moved) break;
  }
  // The squared distance decreased as far as rounding shows. Newton's method continues if it does not leave the foot.
  const Foot end = newton(X, Y);
  const bool stays = (end.Y - Y).norm() < 0.1 * (X - Y).norm() || (X - end.Y).norm() <= (X - Y).norm();
  return stays ? end : Foot{Y, function_(Y), residual(X, Y, function_(Y))};
}

Vector3d ZeroSet::crossing(const Vector3d& X, const Vector3d& other) const {
  const bool is_inside = function_.value(X) < 0;
  double near = 0, far = 1;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (near + far) / 2;
    const bool same = (function_.value(X + middle * (other - X)) < 0) == is_inside;
    (same ? near : far) = middle;
  }
  return X + far * (other - X);
}

}  // namespace plastron::obstacle
