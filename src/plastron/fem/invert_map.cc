#include <plastron/fem/invert_map.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace plastron::fem {

std::optional<Vector2d> invert_map(Shape shape, const CellMap& map, const Vector2d& point) {
  // Part of the cell's size; points far from the origin have larger rounding.
  constexpr double tolerance = 1e-9;
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * point.norm();
  Vector2d xi = centre(shape);
  double size = 0;
  for (int step = 0; step < 30; ++step) {
    const PlaneJet f = map(xi);
    Eigen::Matrix2d jacobian;
    jacobian << f.d[0], f.d[1];
    size = jacobian.norm();
    const Vector2d change = jacobian.fullPivLu().solve(point - f.value);
    xi += change;
    if (change.norm() < 1e-14) break;
    if (!(xi.norm() < 10)) break;
  }
  const Vector2d inside = put_inside(shape, xi);
  if (!((map(inside).value - point).norm() <= tolerance * size + rounding)) return std::nullopt;
  return inside;
}

}  // namespace plastron::fem
