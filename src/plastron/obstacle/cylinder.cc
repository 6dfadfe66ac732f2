#include <plastron/obstacle/cylinder.hpp>
#include <plastron/obstacle/revolution.hpp>

namespace plastron::obstacle {

namespace {

ProfileDistance profile_of(const Cylinder& body, const Vector2d& at) {
  const double side = at[1] < 0 ? -1 : 1;
  const double core_radius = body.radius - body.fillet, core_half = body.length / 2 - body.fillet;
  const Vector2d over(at[0] - core_radius, side * at[1] - core_half);
  const Vector2d up(0, side), out(1, 0);
  if (over[0] >= 0 && over[1] >= 0) {
    ProfileDistance corner = distance_to_point({over[0], side * over[1]});
    corner.distance -= body.fillet;
    return corner;
  }
  return over[0] >= over[1] ? distance_to_line(at[0] - body.radius, out)
                            : distance_to_line(side * at[1] - body.length / 2, up);
}

}  // namespace

Nearest Cylinder::nearest(const Vector3d& X) const {
  const Nearest outside = revolved({point, axis}, X, [&](const Vector2d& at) { return profile_of(*this, at); });
  return inside ? reversed(outside) : outside;
}

}  // namespace plastron::obstacle
