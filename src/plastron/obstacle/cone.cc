#include <plastron/obstacle/cone.hpp>
#include <plastron/obstacle/revolution.hpp>

#include <cmath>

namespace plastron::obstacle {

namespace {

/// Distance to the sharp cone. `along` is the distance down the side from the tip, `off` the distance to the side's
/// line.
ProfileDistance core_distance(double half_angle, const Vector2d& at, double core_height) {
  const double s = std::sin(half_angle), c = std::cos(half_angle);
  const double along = at[0] * s + at[1] * c, off = at[0] * c - at[1] * s, below = at[1] - core_height;
  const Vector2d edge(core_height * (s / c), core_height);
  ProfileDistance side = distance_to_line(off, {c, -s}), base = distance_to_line(below, {0, 1});
  if (off <= 0 && below <= 0) return off >= below ? side : base;
  if (along <= 0) return distance_to_point(at);
  if (off > 0 && along <= core_height / c) return side;
  return at[0] <= edge[0] ? base : distance_to_point(at - edge);
}

}  // namespace

double Cone::largest_fillet() const { return height / (1 / std::sin(half_angle) + 1); }

Nearest Cone::nearest(const Vector3d& X) const {
  const double s = std::sin(half_angle);
  return revolved({apex + fillet / s * axis, axis}, X, [&](const Vector2d& at) {
    ProfileDistance d = core_distance(half_angle, at, height - fillet / s - fillet);
    d.distance -= fillet;
    return d;
  });
}

}  // namespace plastron::obstacle
