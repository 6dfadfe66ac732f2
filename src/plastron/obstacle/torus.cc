#include <plastron/obstacle/revolution.hpp>
#include <plastron/obstacle/torus.hpp>

namespace plastron::obstacle {

Nearest Torus::nearest(const Vector3d& X) const {
  return revolved({centre, axis}, X, [&](const Vector2d& at) {
    ProfileDistance d = distance_to_point({at[0] - radius, at[1]});
    d.distance -= tube_radius;
    return d;
  });
}

}  // namespace plastron::obstacle
