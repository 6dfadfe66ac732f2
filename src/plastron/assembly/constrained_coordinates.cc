#include <plastron/assembly/constrained_coordinates.hpp>

#include <plastron/assembly/contact_coordinates.hpp>
#include <plastron/assembly/state.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace plastron::assembly {

namespace {

/// Component k of (d, length theta), if it is prescribed.
std::optional<double> prescribed(const fem::PlacedBody& placed, int k) {
  const auto& value = placed.body.fixed[static_cast<std::size_t>(k)];
  if (!value) return {};
  return k < 3 ? *value : placed.length * *value;
}

/// Checks one row of a support, `row` on (u, r): the body's prescribed components must already prescribe it.
void check_row(const fem::PlacedBody& placed, const fem::BodyNode& member, const Vector6& row, double value,
               double scale, const NodalPoint& point) {
  constexpr double rounding_part = 1e-9;
  Vector6 on_motion = member.motion.transpose() * row;
  double known = 0, most = scale;
  const double whole = on_motion.norm();
  for (int k = 0; k < 6; ++k)
    if (const auto given = prescribed(placed, k)) {
      known += on_motion[k] * *given;
      most = std::max(most, std::abs(on_motion[k] * *given));
      on_motion[k] = 0;
    }
  if (on_motion.norm() > rounding_part * whole)
    throw SupportError(fmt::format(
        "a support holds the shell at x = {:g}, y = {:g}, where the rigid body \"{}\" carries it; leave that "
        "to the body: fix its motions that the support is to hold",
        point.x[0], point.x[1], placed.body.name));
  if (!(std::abs(known - value) <= rounding_part * most))
    throw SupportError(
        fmt::format("a support contradicts the rigid body \"{}\" at x = {:g}, y = {:g}: a component that the body "
                    "prescribes as {:g} is to be {:g}, which differs by {:.2g}",
                    placed.body.name, point.x[0], point.x[1], known, value, std::abs(known - value)));
}

void check_supports(const fem::PlacedBody& placed, const fem::BodyNode& member, const NodalPoint& point,
                    const NodeSupport& support) {
  for (const auto& [direction, value] : support.displacement) {
    Vector6 row;
    row << direction, Vector3d::Zero();
    check_row(placed, member, row, value, support.displacement_scale, point);
  }
  if (!placed.body.turns_normals) return;
  for (const auto& [direction, value] : support.rotation) {
    const Vector3d tangential = geometry::tangential(direction, point.a3);
    if (tangential.norm() < 1e-9) continue;  // r . a_3 is zero there
    Vector6 row;
    row << Vector3d::Zero(), tangential;
    check_row(placed, member, row, value, support.rotation_scale, point);
  }
}

/// Returns an orthonormal basis of the projector's range.
std::vector<Vector3d> orthonormal_range(const Eigen::Matrix3d& projector) {
  const auto modes = geometry::symmetric_eigen(projector);
  std::vector<Vector3d> range;
  for (int k = 0; k < 3; ++k)
    if (modes.values[k] > 0.5) range.emplace_back(modes.vectors.col(k));
  return range;
}

/// Returns a support that fixes the displacement in all directions. It also fixes the rotation where the body
/// determines it.
NodeSupport all_fixed(const NodalPoint& point, const NodeSupport& support, bool is_hinge) {
  NodeSupport all;
  for (int axis = 0; axis < 3; ++axis) all.displacement.emplace_back(Vector3d::Unit(axis), 0);
  if (is_hinge) {
    all.rotation = support.rotation;
    all.rotation_scale = support.rotation_scale;
  } else {
    for (const Vector3d& direction : across(point.a3)) all.rotation.emplace_back(direction, 0);
  }
  return all;
}

/// Returns coordinates with u and a part of r fixed at zero: u follows from another node, and the kink leaves the rest
/// of r. A hinge leaves all of it but r . a_3.
NodeCoordinates kinked_coordinates(const constraints::Row& row, const NodalPoint& point, const NodeSupport& support,
                                   double size) {
  NodeSupport all;
  for (int axis = 0; axis < 3; ++axis) all.displacement.emplace_back(Vector3d::Unit(axis), 0);
  all.rotation_scale = support.rotation_scale;
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - row.own().bottomRightCorner<3, 3>();
  for (const Vector3d& direction : orthonormal_range(rest)) all.rotation.emplace_back(direction, 0);
  all.rotation.insert(all.rotation.end(), support.rotation.begin(), support.rotation.end());
  NodeCoordinates coordinates = node_coordinates(point, all, {}, {}, Vector6::Zero(), size);
  coordinates.lower[5] = coordinates.upper[5] = 0;
  return coordinates;
}

NodeCoordinates body_coordinates(const fem::PlacedBody& placed, const fem::BodyNode& member, const NodalPoint& point,
                                 const NodeSupport& support, double size) {
  check_supports(placed, member, point, support);
  NodeCoordinates coordinates =
      node_coordinates(point, all_fixed(point, support, !placed.body.turns_normals), {}, {}, Vector6::Zero(), size);
  for (int h = 0; h < 2; ++h) {
    if (placed.hosts[static_cast<std::size_t>(h)] != member.node) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < 6; ++k) {
        if (coordinates.basis(axis, static_cast<Eigen::Index>(k)) == 0) continue;
        const auto value = prescribed(placed, 3 * h + axis);
        coordinates.lower[k] = value.value_or(-std::numeric_limits<double>::infinity());
        coordinates.upper[k] = value.value_or(std::numeric_limits<double>::infinity());
      }
  }
  return coordinates;
}

}  // namespace

NodeCoordinates constrained_coordinates(const fem::Space& space, algebra::LocalIndex node, const NodalPoint& point,
                                        const NodeSupport& support, double size) {
  for (const fem::PlacedBody& placed : space.bodies)
    if (const fem::BodyNode* member = placed.find(node)) return body_coordinates(placed, *member, point, support, size);
  if (space.kinks.constrains(node)) return kinked_coordinates(*space.constraints.find(node), point, support, size);
  return {};
}

}  // namespace plastron::assembly
