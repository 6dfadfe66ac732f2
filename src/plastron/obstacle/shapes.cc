#include <plastron/obstacle/shapes.hpp>

namespace plastron::obstacle {

using geometry::Vector2d;

namespace {

// Solids of revolution: a signed distance in the half-plane (rho, z) of an axis becomes a distance in space.

/// A line in space that defines the half-plane's coordinates: z along it, rho >= 0 away from it.
struct Axis {
  Vector3d point = Vector3d::Zero();       ///< point with z = 0 [m]
  Vector3d direction = Vector3d::UnitZ();  ///< unit vector
};

/// d(rho, z) with its derivatives.
struct ProfileDistance {
  double distance;            ///< positive outside of the body [m]
  Vector2d gradient;          ///< a unit vector
  Eigen::Matrix2d curvature;  ///< Hessian [1/m]
};

/// Distance to a point at the vector `from_centre`: the gradient is radial, the curvature 1/d across.
ProfileDistance distance_to_point(const Vector2d& from_centre) {
  const double length = from_centre.stableNorm();
  const Vector2d n = length > 0 ? Vector2d(from_centre / length) : Vector2d::UnitY();
  const Vector2d t(-n[1], n[0]);
  return {length, n, length > 0 ? Eigen::Matrix2d(t * t.transpose() / length) : Eigen::Matrix2d::Zero()};
}

/// Distance to a straight line whose unit normal is n.
ProfileDistance distance_to_line(double distance, const Vector2d& n) { return {distance, n, Eigen::Matrix2d::Zero()}; }

/// Returns values in space for d from profile(rho, z): grad d = d_rho e_rho + d_z e. The Hessian has the additional
/// term d_rho/rho around the axis, with the limit d_rho,rho on the axis where d is smooth. Where d is not smooth,
/// e_rho is an arbitrary direction across and d_rho/rho is omitted.
template <class Profile>
Nearest revolved(const Axis& axis, const Vector3d& X, const Profile& profile) {
  const Vector3d from_point = X - axis.point;
  const double z = from_point.dot(axis.direction);
  const Vector3d across = from_point - z * axis.direction;
  const double rho = across.stableNorm();
  const Vector3d e_rho = rho > 0 ? Vector3d(across / rho) : axis.direction.unitOrthogonal();
  const Vector3d e_phi = axis.direction.cross(e_rho);
  const ProfileDistance d = profile(Vector2d(rho, z));
  const double at_axis = d.gradient[0] == 0 ? d.curvature(0, 0) : 0;
  Eigen::Matrix<double, 3, 2> plane;
  plane << e_rho, axis.direction;
  return {d.distance, plane * d.gradient,
          plane * d.curvature * plane.transpose() +
              (rho > 0 ? d.gradient[0] / rho : at_axis) * (e_phi * e_phi.transpose())};
}

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

Nearest Ball::nearest(const Vector3d& X) const {
  const Vector3d from_centre = X - centre;
  const double length = from_centre.stableNorm(), side = inside ? -1 : 1;
  const Vector3d n = length > 0 ? Vector3d(from_centre / length) : Vector3d::UnitZ();
  const Matrix3d bend = length > 0 ? Matrix3d((Matrix3d::Identity() - n * n.transpose()) / length) : Matrix3d::Zero();
  return {side * (length - radius), side * n, side * bend};
}

std::optional<Extent> Ball::extent() const { return extent_around(centre, extent_margin * radius); }

Nearest Box::nearest(const Vector3d& X) const {
  const Vector3d at = axes.transpose() * (X - centre);
  const Vector3d side = at.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
  const Vector3d over_face = at.cwiseAbs() - size / 2;
  const Eigen::Array3d over_core = over_face.array() + fillet;
  const auto bends = (over_core > 0 || size.array() / 2 == fillet).eval();
  const Vector3d beyond = bends.select(over_core, 0);
  const double length = beyond.stableNorm();
  if (bends.count() < 2 || length == 0) {
    int face = 0;
    const double distance = over_face.maxCoeff(&face);
    return {distance, side[face] * axes.col(face), Matrix3d::Zero()};
  }
  const Vector3d n = beyond.cwiseProduct(side) / length;
  const Matrix3d bent = bends.cast<double>().matrix().asDiagonal();
  const Matrix3d curvature = (bent - n * n.transpose()) / length;
  return {length - fillet, axes * n, axes * curvature * axes.transpose()};
}

Nearest Cylinder::nearest(const Vector3d& X) const {
  const Nearest outside = revolved({point, axis}, X, [&](const Vector2d& at) { return profile_of(*this, at); });
  return inside ? reversed(outside) : outside;
}

double Cone::largest_fillet() const { return height / (1 / std::sin(half_angle) + 1); }

Nearest Cone::nearest(const Vector3d& X) const {
  const double s = std::sin(half_angle);
  return revolved({apex + fillet / s * axis, axis}, X, [&](const Vector2d& at) {
    ProfileDistance d = core_distance(half_angle, at, height - fillet / s - fillet);
    d.distance -= fillet;
    return d;
  });
}

Nearest Torus::nearest(const Vector3d& X) const {
  return revolved({centre, axis}, X, [&](const Vector2d& at) {
    ProfileDistance d = distance_to_point({at[0] - radius, at[1]});
    d.distance -= tube_radius;
    return d;
  });
}

}  // namespace plastron::obstacle
