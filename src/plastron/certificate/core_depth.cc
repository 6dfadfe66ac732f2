#include <plastron/certificate/core_depth.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plastron::certificate {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

double radius_inside(const obstacle::HalfSpace& /*shape*/) { return no_limit; }
double radius_inside(const obstacle::HeightField& /*shape*/) { return no_limit; }
double radius_inside(const obstacle::Ball& ball) { return ball.inside ? no_limit : ball.radius; }
double radius_inside(const obstacle::Cylinder& cylinder) {
  return cylinder.inside ? no_limit : std::min(cylinder.radius, cylinder.length / 2);
}
double radius_inside(const obstacle::Box& box) { return box.size.minCoeff() / 2; }
double radius_inside(const obstacle::Torus& torus) { return torus.tube_radius; }
double radius_inside(const obstacle::Cone& cone) { return std::isinf(cone.height) ? no_limit : cone.largest_fillet(); }

/// Radius of the largest ball inside of the body, if there is a formula.
std::optional<double> known_radius(const obstacle::Shape& shape) {
  return std::visit(
      [](const auto& body) -> std::optional<double> {
        if constexpr (requires { radius_inside(body); })
          return radius_inside(body);
        else
          return {};
      },
      shape);
}

}  // namespace

bool has_far_side(const obstacle::Obstacle& obstacle) { return !std::isinf(known_radius(obstacle.shape).value_or(0)); }

double core_depth(const obstacle::Obstacle& obstacle, const Vector3d& X, const obstacle::Nearest& near, double wanted) {
  if (const auto radius = known_radius(obstacle.shape)) return *radius;
  return std::max(0.0, -obstacle.nearest(X - (near.distance + wanted) * near.normal).distance);
}

}  // namespace plastron::certificate
