#include <plastron/obstacle/error.hpp>
#include <plastron/obstacle/obstacle.hpp>

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace plastron::obstacle {

namespace {

std::string point_text(const Vector3d& X) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", X[0], X[1], X[2]); }

}  // namespace

std::string Obstacle::text() const { return name.empty() ? "the obstacle" : fmt::format("the obstacle \"{}\"", name); }

bool Obstacle::has_edges() const {
  if (const auto* box = std::get_if<Box>(&shape)) return box->fillet == 0;
  if (const auto* cone = std::get_if<Cone>(&shape)) return cone->fillet == 0;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return cylinder->fillet == 0 && !cylinder->inside && std::isfinite(cylinder->length);
  return std::holds_alternative<TriangleSurface>(shape);
}

Obstacle Obstacle::standing(double time, double position) const {
  Obstacle result = *this;
  result.motions.clear();
  result.placement = moved(placement, motions, time);
  if (position != 0) result.placement.translation += position * force.normalized();
  return result;
}

Nearest Obstacle::nearest(const Vector3d& X) const {
  const Vector3d in_body = placement.to_body(X);
  try {
    return placement.to_space(std::visit([&](const auto& body) { return body.nearest(in_body); }, shape));
  } catch (const ObstacleError& error) {
    const std::string own = in_body == X ? "" : fmt::format(", {} in its own coordinates", point_text(in_body));
    throw ObstacleError(fmt::format("{} at the point {} of space{}: {}", text(), point_text(X), own, error.what()));
  }
}

void Obstacle::prepare(std::span<const Vector3d> X) const {
  const auto* field = std::get_if<DistanceField>(&shape);
  if (!field) return;
  std::vector<Vector3d> in_body;
  in_body.reserve(X.size());
  for (const Vector3d& x : X) in_body.push_back(placement.to_body(x));
  field->prepare(in_body);
}

}  // namespace plastron::obstacle
