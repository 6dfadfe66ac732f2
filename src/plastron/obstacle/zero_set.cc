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

/// Whether the surface, as its second derivatives at the foot show, bends little away from X within the distance.
bool bends_little(const Vector3d& X, const ZeroSet::Foot& foot, double share) {
  const double size = foot.f.gradient.norm();
  const Vector3d n = foot.f.gradient / size;
  const Matrix3d bend = (X - foot.Y).dot(n) * surface_curvature(n, size, foot.f.hessian);
  return geometry::symmetric_eigen(bend).values[0] > -share;
}

/// Radii of the spheres around X, as parts of the distance, on which samples lie.
constexpr std::array<double, 3> sampled_radii{0.4, 0.7, 1};

void add_samples(const Vector3d& X, const ZeroSet::Foot& foot, std::vector<Vector3d>& samples) {
  const double radius = (X - foot.Y).norm();
  for (const double part : sampled_radii)
    for (const Vector3d& direction : directions_around()) samples.push_back(X + part * radius * direction);
}

/// Whether samples exclude a nearer part of the surface. In the ball around X through the foot, n . w > |w|^2 / (2 r) for w = Y -
/// foot. So F keeps its sign there if it differs from its tangent at the foot by less than |F'| |w|^2 / (2 r), as it does for
/// |F''| r < |F'|. Samples must show a part of this, `share`.
bool excludes_others(const Vector3d& X, const ZeroSet::Foot& foot, std::span<const Vector3d> samples,
                     std::span<const double> values, double share) {
  const double radius = (X - foot.Y).norm(), size = foot.f.gradient.norm();
  const double side = (X - foot.Y).dot(foot.f.gradient) < 0 ? -1 : 1;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Vector3d w = samples[k] - foot.Y;
    const double bent = side * (values[k] - foot.f.gradient.dot(w)) / size;
    if (!(bent >= -share * w.squaredNorm() / (2 * radius) - foot.rounding(X))) return false;
  }
  return true;
}

}  // namespace

const std::array<Vector3d, 26>& directions_around() {
  static const auto all = [] {
    std::array<Vector3d, 26> made;
    std::size_t count = 0;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (i != 0 || j != 0 || k != 0) made[count++] = Vector3d(i, j, k).normalized();
    return made;
  }();
  return all;
}

std::vector<std::optional<ZeroSet::Foot>> ZeroSet::sure_feet(std::span<const Vector3d> X) const {
  constexpr int most_steps = 20;
  const std::vector<SpaceJet> first = function_.jets(X);
  std::vector<std::optional<Foot>> feet(X.size());
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < X.size(); ++i) {
    if (!is_usable(first[i])) continue;
    feet[i] = Foot{X[i], first[i], residual(X[i], X[i], first[i])};
    if (feet[i]->off > 0) moving.push_back(i);
  }
  for (int step = 0; step < most_steps && !moving.empty(); ++step) {
    std::vector<Vector3d> trials;
    trials.reserve(moving.size());
    for (const std::size_t i : moving) trials.push_back(feet[i]->Y + newton_step(X[i], feet[i]->Y, feet[i]->f));
    const std::vector<SpaceJet> there = function_.jets(trials);
    std::vector<std::size_t> next;
    for (std::size_t k = 0; k < moving.size(); ++k) {
      Foot& foot = *feet[moving[k]];
      const Vector3d& x = X[moving[k]];
      const double off = is_usable(there[k]) ? residual(x, trials[k], there[k]) : foot.off;
      const double before = foot.off, way = (trials[k] - foot.Y).norm();
      if (off < before) foot = {trials[k], there[k], off};
      if (off > 0 && off < before / 2 && way > 1e-15 * (x.norm() + (x - foot.Y).norm())) next.push_back(moving[k]);
    }
    moving = std::move(next);
  }
  drop_unsure(X, feet);
  return feet;
}

void ZeroSet::drop_unsure(std::span<const Vector3d> X, std::span<std::optional<Foot>> feet) const {
  constexpr double share = 0.3;  // sampled part of the bend that could let the surface come nearer
  constexpr std::size_t at_once = 64;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < X.size(); ++i) {
    if (!feet[i]) continue;
    if (!feet[i]->is_found(X[i]) || feet[i]->has_no_side(X[i]) || !bends_little(X[i], *feet[i], share))
      feet[i].reset();
    else if ((X[i] - feet[i]->Y).norm() > feet[i]->rounding(X[i]))
      open.push_back(i);
  }
  for (std::size_t begin = 0; begin < open.size(); begin += at_once) {
    const auto some = std::span(open).subspan(begin, std::min(at_once, open.size() - begin));
    std::vector<Vector3d> samples;
    for (const std::size_t i : some) add_samples(X[i], *feet[i], samples);
    const std::vector<double> values = function_.values(samples);
    const std::size_t each = samples.size() / some.size();
    for (std::size_t k = 0; k < some.size(); ++k)
      if (!excludes_others(X[some[k]], *feet[some[k]], std::span(samples).subspan(k * each, each),
                           std::span(values).subspan(k * each, each), share))
        feet[some[k]].reset();
  }
}

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
