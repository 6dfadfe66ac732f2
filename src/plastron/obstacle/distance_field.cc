#include <plastron/geometry/quotation.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/obstacle/distance_field.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/known_distances.hpp>
#include <plastron/obstacle/zero_set.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace plastron::obstacle {

namespace {

using geometry::SpaceFunction;
using geometry::SpaceJet;
using Foot = ZeroSet::Foot;

[[noreturn]] void refuse(const SpaceFunction& F, const std::string& what) {
  throw ObstacleError(fmt::format("the distance expression \"{}\" {}", geometry::shortened(F.text()), what));
}

[[noreturn]] void refuse_for_kinks(const SpaceFunction& F) {
  refuse(F,
         "leads to no point of the body's surface that is nearest; it must change its sign at the surface and be "
         "differentiable twice near it, without kinks there as abs has");
}

/// F at X. Refuses points where F does not determine the way to the surface.
SpaceJet usable_jet(const SpaceFunction& F, const Vector3d& X) {
  SpaceJet f = F(X);
  if (!std::isfinite(f.value)) refuse(F, "is not finite there; it must be wherever the shell is");
  if (!f.hessian.allFinite() || !f.gradient.allFinite())
    refuse(F, fmt::format("is {:.4g} there, but its first two derivatives are not finite; they must be wherever the "
                          "shell is",
                          f.value));
  if (f.gradient.isZero(0))
    refuse(F,
           fmt::format("is {:.4g} and has a zero gradient there, so that no side of the body is the nearest; move the "
                       "body, or write an expression whose gradient is not zero there",
                       f.value));
  return f;
}

/// A point at the distance `radius` from X where F has the opposite sign; empty if none is found.
std::optional<Vector3d> other_side(const SpaceFunction& F, const Vector3d& X, double radius) {
  const double at_X = F.value(X);
  std::vector<Vector3d> places;
  for (const Vector3d& direction : directions_around()) places.push_back(X + radius * direction);
  const std::vector<double> values = F.values(places);
  const auto other = std::ranges::find_if(values, [&](double value) { return value * at_X < 0; });
  if (other == values.end()) return {};
  return places[static_cast<std::size_t>(other - values.begin())];
}

/// A point of the surface on the way from X to a point where F has the opposite sign, which Newton's method for an extremum of F finds.
/// This finds bodies that no direction of other_side() meets.
std::optional<Vector3d> surface_below(const SpaceFunction& F, const Vector3d& X, const SpaceJet& f) {
  constexpr int most_steps = 20;
  constexpr double least_curvature = 1e-3, least_share = 1e-3;
  const double sign = f.value > 0 ? 1 : -1;
  Vector3d Y = X;
  SpaceJet at = f;
  for (int step = 0; step < most_steps && at.gradient.norm() > 0; ++step) {
    const auto eigen = geometry::symmetric_eigen(at.hessian);
    const double least = least_curvature * at.gradient.squaredNorm() / std::abs(at.value);
    const Vector3d slopes = eigen.vectors.transpose() * at.gradient;
    const Vector3d full = -sign * (eigen.vectors * slopes.cwiseQuotient(eigen.values.cwiseAbs().cwiseMax(least)));
    double share = 1;
    while (share > least_share && !(sign * F.value(Y + share * full) < sign * at.value)) share /= 2;
    Y += share * full;
    at = F(Y);
    if (sign * at.value < 0) return ZeroSet(F).crossing(X, Y);
  }
  return {};
}

/// A point of the surface on the smallest sphere with both signs of F. The radii are |F| / |F'| times 2^-4 to 2^10.
Vector3d point_on_surface(const SpaceFunction& F, const Vector3d& X, const SpaceJet& f) {
  constexpr int first = -4, last = 10;
  constexpr double close = 1e-10;
  const double guess = std::abs(f.value) / f.gradient.norm();
  bool changes_sign = false;
  for (int power = first; power <= last; ++power)
    if (const auto other = other_side(F, X, std::ldexp(guess, power))) {
      changes_sign = true;
      const ZeroSet surface(F);
      if (const auto Y = surface.projected(surface.crossing(X, *other), close * (X - *other).norm())) return *Y;
    }
  if (changes_sign) refuse_for_kinks(F);
  if (const auto Y = surface_below(F, X, f)) return *Y;
  refuse(F, fmt::format(
                "is {:.4g} there and has that sign as far as {:.3g} m away: no surface of a body is near; the body "
                "is where it is negative, and it must change its sign at the surface (are its constants and "
                "lengths right?)",
                f.value, std::ldexp(guess, last)));
}

/// Finds a foot of X, possibly not the nearest.
Foot any_foot(const SpaceFunction& F, const Vector3d& X) {
  const SpaceJet f = usable_jet(F, X);
  const ZeroSet surface(F);
  Foot direct = surface.newton(X, X);
  if (direct.is_found(X)) return direct;
  const auto beside = surface.projected(direct.Y, 1e-10 * (X - direct.Y).norm());
  return surface.descend(X, beside ? *beside : point_on_surface(F, X, f));
}

/// Whether the surface bends away from X at the foot; then the foot is no local minimum of the distance.
bool is_no_minimum(const Vector3d& X, const Foot& foot) {
  const double size = foot.f.gradient.norm();
  const Vector3d n = foot.f.gradient / size;
  const Matrix3d model = Matrix3d::Identity() + (X - foot.Y).dot(n) * surface_curvature(n, size, foot.f.hessian);
  return geometry::symmetric_eigen(model).values[0] < -1e-6;
}

/// Searches for feet nearer than `foot` on other parts of the surface near the sphere around X through `foot`.
Foot nearer_elsewhere(const SpaceFunction& F, const Vector3d& X, Foot foot) {
  constexpr double close = 0.4, same_direction = 0.64;
  constexpr std::size_t most_descents = 4;
  struct Start {
    double off;  // approximate distance of the surface from the sphere
    Vector3d direction;
  };
  const double radius = (X - foot.Y).norm();
  if (!(radius > 0)) return foot;
  std::vector<Vector3d> known{(foot.Y - X) / radius};
  std::vector<Start> starts;
  std::vector<Vector3d> directions, places;
  for (const Vector3d& direction : directions_around()) {
    if (direction.dot(known[0]) > same_direction) continue;
    directions.push_back(direction);
    places.push_back(X + radius * direction);
  }
  const std::vector<SpaceJet> jets = F.jets(places);
  for (std::size_t k = 0; k < jets.size(); ++k) {
    const double off = std::abs(jets[k].value) / jets[k].gradient.norm();
    if (off < close * radius) starts.push_back({off, directions[k]});
  }
  std::ranges::stable_sort(starts, {}, &Start::off);
  for (const Start& start : starts) {
    const auto is_same = [&](const Vector3d& u) { return u.dot(start.direction) > same_direction; };
    if (known.size() > most_descents || std::ranges::any_of(known, is_same)) continue;
    known.push_back(start.direction);
    const auto Y = ZeroSet(F).projected(X + radius * start.direction, 1e-10 * radius);
    if (!Y) continue;
    const Foot other = ZeroSet(F).descend(X, *Y);
    if (other.is_found(X) && (X - other.Y).norm() < (X - foot.Y).norm()) foot = other;
  }
  return foot;
}

/// Searches for feet nearer than `foot` where F changes its sign nearer to X.
Foot nearer_side(const SpaceFunction& F, const Vector3d& X, Foot foot) {
  constexpr int most_restarts = 10;
  for (int restart = 0; restart < most_restarts; ++restart) {
    std::optional<Vector3d> other;
    const double distance = (X - foot.Y).norm();
    for (const double share : {0.4, 0.7})
      if (!other) other = other_side(F, X, share * distance);
    if (!other) break;
    const Foot nearer = ZeroSet(F).descend(X, ZeroSet(F).crossing(X, *other));
    if (!nearer.is_found(X) || !((X - nearer.Y).norm() < distance)) break;
    foot = nearer;
  }
  return foot;
}

/// The foot of a point whose nearest one is not sure without a search.
Foot searched_foot(const SpaceFunction& F, const Vector3d& X) {
  Foot foot = nearer_side(F, X, any_foot(F, X));
  if (foot.has_no_side(X))
    refuse(F, "has a zero gradient where it is zero itself, as squares have; write one that changes its sign there");
  if (foot.is_found(X) && is_no_minimum(X, foot)) foot = ZeroSet(F).descend(X, foot.Y);
  foot = nearer_elsewhere(F, X, foot);
  if (!foot.is_found(X)) refuse_for_kinks(F);
  return foot;
}

Nearest nearest_of(const Vector3d& X, const Foot& foot) {
  const double size = foot.f.gradient.norm();
  const Vector3d n = foot.f.gradient / size;
  const double distance = (X - foot.Y).dot(n);
  return {distance, n, offset_curvature(surface_curvature(n, size, foot.f.hessian), distance)};
}

}  // namespace

DistanceField::DistanceField(std::shared_ptr<const geometry::SpaceFunction> expression)
    : function_(std::move(expression)), known_(std::make_shared<KnownDistances>()) {
  if (!function_->depends_on(0) && !function_->depends_on(1) && !function_->depends_on(2))
    throw ObstacleError("the expression is the same everywhere: its gradient is zero");
}

Nearest DistanceField::nearest(const Vector3d& X) const {
  if (const Nearest* known = known_->find(X)) return *known;
  prepare({&X, 1});
  if (const Nearest* known = known_->find(X)) return *known;
  Nearest found = nearest_of(X, searched_foot(*function_, X));
  known_->add(X, found);
  return found;
}

void DistanceField::prepare(std::span<const Vector3d> X) const {
  std::vector<Vector3d> unknown;
  std::ranges::copy_if(X, std::back_inserter(unknown), [&](const Vector3d& x) { return !known_->find(x); });
  if (unknown.empty()) return;
  known_->forget_if_many();
  const auto feet = ZeroSet(*function_).sure_feet(unknown);
  for (std::size_t i = 0; i < feet.size(); ++i)
    if (feet[i]) known_->add(unknown[i], nearest_of(unknown[i], *feet[i]));
}

}  // namespace plastron::obstacle
