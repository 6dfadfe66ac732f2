#include <plastron/geometry/quotation.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>
#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/graph_search.hpp>
#include <plastron/obstacle/height_field.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace plastron::obstacle {

namespace {

using Eigen::Vector2d;
using Heights = std::variant<std::shared_ptr<const geometry::SpaceFunction>, std::shared_ptr<const Raster>>;

/// Limit of the reach times h'' for which the distance is convex within the reach.
constexpr double surely_convex = 0.3;

/// Newton's step with the absolute eigenvalues of the Hessian. It leaves a point between two close feet, which occur
/// for an X just beyond a centre of curvature. Steps by the convex part are very short there.
Vector2d away_from_ridge(const GraphObjective& f) {
  constexpr double least = 1e-6;
  const auto eigen = geometry::symmetric_eigen(f.hessian);
  const Vector2d sizes = eigen.values.cwiseAbs().cwiseMax(least);
  return -eigen.vectors * (eigen.vectors.transpose() * f.gradient).cwiseQuotient(sizes);
}

/// The length that the rounding of a height is relative to: on a slope, rounding of p changes the height.
double length_of_coordinates(const Vector3d& X, const Vector2d& p, const HeightJet& h) {
  return (1 + h.gradient.norm()) * X.norm() + (p - X.head<2>()).norm();
}

HeightJet jet_of(const Heights& heights, const Vector2d& p) {
  if (const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights)) return (**raster)(p);
  const auto jet = (*std::get<0>(heights))({p[0], p[1], 0});
  return {jet.value, jet.gradient.head<2>(), jet.hessian.topLeftCorner<2, 2>()};
}

}  // namespace

HeightField::HeightField(std::shared_ptr<const geometry::SpaceFunction> expression) : heights_(expression) {
  if (expression->depends_on(2)) throw ObstacleError("a height is an expression of X and Y, not of Z");
  samples_ = std::make_shared<GraphSamples>([heights = heights_](const Vector2d& p) { return jet_of(heights, p); });
}

HeightField::HeightField(std::shared_ptr<const Raster> raster) : heights_(raster) {
  samples_ = std::make_shared<GraphSamples>([raster](const Vector2d& p) {
    return raster->covers(p) ? (*raster)(p) : HeightJet{.value = std::numeric_limits<double>::quiet_NaN()};
  });
}

bool HeightField::covers(const Vector2d& p) const {
  const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights_);
  return !raster || (*raster)->covers(p);
}

HeightJet HeightField::height(const Vector2d& p) const { return jet_of(heights_, p); }

double HeightField::level(const Vector3d& X) const {
  return covers(X.head<2>()) ? X[2] - height(X.head<2>()).value : std::numeric_limits<double>::quiet_NaN();
}

void HeightField::refuse(const std::string& what) const {
  const auto* raster = std::get_if<std::shared_ptr<const Raster>>(&heights_);
  if (!raster)
    throw ObstacleError(
        fmt::format("the height field \"{}\" {}", geometry::shortened(std::get<0>(heights_)->text()), what));
  throw ObstacleError(fmt::format(
      "the height field {}; the raster covers X from {:.6g} to {:.6g} and Y from {:.6g} to {:.6g} in its own "
      "coordinates and must reach beyond the shell on all sides by as much as the two are apart: give a larger raster, "
      "or move it",
      what, (*raster)->from()[0], (*raster)->to()[0], (*raster)->from()[1], (*raster)->to()[1]));
}

// Newton's method where the objective is convex, else without the non-convex part of the Hessian. Steps are halved
// until the objective decreases.
HeightField::Foot HeightField::descend(const Vector3d& X, Vector2d p) const {
  constexpr int most_steps = 100;
  HeightJet h = height(p);
  GraphObjective f = graph_objective(X, p, h);
  for (int step = 0; step < most_steps && !f.gradient.isZero(0); ++step) {
    const bool newton = is_positive(f.hessian);
    const bool is_slow = step >= 20;
    const Vector2d full = newton    ? Vector2d(-f.hessian.inverse() * f.gradient)
                          : is_slow ? away_from_ridge(f)
                                    : Vector2d(-f.convex_part.inverse() * f.gradient);
    bool moved = false;
    for (double share = 1; share > 1e-9 && !moved; share /= 2) {
      const Vector2d trial = p + share * full;
      if (!covers(trial) || trial == p) continue;
      const HeightJet there = height(trial);
      const GraphObjective next = graph_objective(X, trial, there);
      const bool descends = next.value < f.value + 1e-4 * share * f.gradient.dot(full);
      // Rounding of the objective is rounding of a height times the distance. Below it only the gradient shows that
      // the objective still decreases.
      const double unseen = 1e-14 * f.value + 1e-15 * std::sqrt(2 * f.value) * length_of_coordinates(X, trial, there);
      const bool polishes = newton && next.value <= f.value + unseen && next.gradient.norm() < f.gradient.norm() / 2;
      if (!descends && !polishes) continue;
      p = trial, h = there, f = next, moved = true;
    }
    if (!moved) break;
  }
  // The gradient has the rounding of the height times the slope.
  const double rounding = 1e-9 * (1 + h.gradient.norm()) * length_of_coordinates(X, p, h);
  return {p, h, f.value, f.gradient.norm() <= 1e-6 * std::max(std::sqrt(2 * f.value), rounding)};
}

/// No sample of the graph on two rings is nearer, and the graph bends too little within the distance for another
/// foot.
bool HeightField::is_surely_nearest(const Vector3d& X, const Foot& foot) const {
  const double reach = std::sqrt(2 * foot.value);
  constexpr int rings = 2;
  for (int ring = 1; ring <= rings; ++ring)
    for (int k = 0; k < 4 * (ring + 1); ++k) {
      const double turn = 2 * std::numbers::pi * (k + 0.5 * (ring % 2)) / (4 * (ring + 1));
      const Vector2d at = X.head<2>() + reach * ring / rings * Vector2d(std::cos(turn), std::sin(turn));
      if (!covers(at)) continue;
      const HeightJet h = height(at);
      if (!(h.hessian.norm() * reach < surely_convex)) return false;
      if (graph_objective(X, at, h).value < foot.value * (1 - 1e-9)) return false;
    }
  return true;
}

/// The nearest foot of all descents from promising starts.
HeightField::Foot HeightField::nearer_foot(const Vector3d& X, const Foot& known) const {
  constexpr std::size_t most_descents = 100;
  Foot best = known;
  std::vector<Vector2d> feet{known.p};
  const double distance = std::sqrt(2 * known.value);
  const GraphStarts found = starts_nearer_than(distance, X, *samples_);
  if (found.missed > 0)
    throw ObstacleError(fmt::format(
        "the height field is {:.3g} m away and has waves shorter than {:.2g} m, too many to find the nearest "
        "point among; leave out the fine waves, or bring the shell nearer",
        distance, GraphSamples::least_samples_of_wave * found.missed));
  for (const GraphStart& start : found.starts) {
    if (!(start.least < best.value) || feet.size() > most_descents) break;
    const auto is_near = [&](const Vector2d& p) { return (start.p - p).norm() < start.spacing; };
    if (!covers(start.p) || std::ranges::any_of(feet, is_near)) continue;
    const Foot foot = descend(X, start.p);
    feet.push_back(foot.p);
    if (foot.value < best.value) best = foot;
  }
  return best;
}

Nearest HeightField::nearest(const Vector3d& X) const {
  if (!covers(X.head<2>())) refuse("has no height there");
  samples_->forget_if_many();
  Foot foot = descend(X, X.head<2>());
  if (!std::isfinite(foot.value))
    refuse("is not finite there; it and its first two derivatives must be, wherever the shell is");
  // A much nearer foot justifies a search with correspondingly denser samples.
  for (double before = 0; before != foot.value && !is_surely_nearest(X, foot);) {
    before = foot.value;
    foot = nearer_foot(X, foot);
    if (foot.value > before / 4) break;
  }
  if (!foot.is_stationary)
    refuse(is_raster() ? "has no nearest point there, or one at its edge"
                       : "has no nearest point there; it must be differentiable twice, without kinks");
  const HeightJet& h = foot.h;
  const double slope = std::sqrt(1 + h.gradient.squaredNorm());
  const Vector3d n = Vector3d(-h.gradient[0], -h.gradient[1], 1) / slope;
  const double distance = (X - Vector3d(foot.p[0], foot.p[1], h.value)).dot(n);
  Matrix3d bent = Matrix3d::Zero();
  bent.topLeftCorner<2, 2>() = -h.hessian;
  return {distance, n, offset_curvature(surface_curvature(n, slope, bent), distance)};
}

}  // namespace plastron::obstacle
