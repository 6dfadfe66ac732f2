#include <plastron/assembly/deformed.hpp>

#include <plastron/assembly/contact_coordinates.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/fem/kept_angles.hpp>
#include <plastron/geometry/symmetric_eigen.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace plastron::assembly {

namespace {

using Eigen::Matrix3d;

void carry(const fem::PlacedBody& placed, const fem::BodyPlace& place, const std::vector<NodalPoint>& points,
           algebra::Vector& y) {
  const Matrix3d change = place.turn - Matrix3d::Identity();
  for (const fem::BodyNode& member : placed.members) {
    const auto node = static_cast<std::size_t>(member.node);
    double* values = y.at(node).data();
    Eigen::Map<Vector3d>{values} = place.displacement + change * (points[node].phi - placed.body.reference);
    if (placed.body.turns_normals) Eigen::Map<Vector3d>{values + 3} = change * points[node].a3;
  }
}

std::vector<Vector3d> normals_of(const std::vector<NodalPoint>& points) {
  std::vector<Vector3d> normals;
  normals.reserve(points.size());
  for (const NodalPoint& point : points) normals.push_back(point.a3);
  return normals;
}

/// Where all three components of r are prescribed, replaces them by the way to the director, tangential to the present one.
/// Returns whether it has done this.
bool prescribes_director(const Vector3d& a3, const Vector3d& now, NodeSupport& support) {
  const std::optional<Vector3d> director = prescribed_director(a3, support);
  if (!director) return false;
  const Vector3d way = now.norm() * director->normalized() - now;
  support.rotation.clear();
  for (const Vector3d& direction : across(now)) support.rotation.emplace_back(direction, direction.dot(way));
  return true;
}

}  // namespace

std::optional<Vector3d> prescribed_director(const Vector3d& a3, const NodeSupport& support) {
  constexpr double independent = 1e-6;
  Matrix3d rows = Matrix3d::Zero();
  Vector3d values = Vector3d::Zero();
  for (const auto& [direction, value] : support.rotation) {
    rows += direction * direction.transpose();
    values += value * direction;
  }
  if (!(geometry::symmetric_eigen(rows).values[0] > independent)) return {};
  return a3 + rows.ldlt().solve(values);
}

std::vector<fem::BodyPlace> body_places(const fem::Space& space, const algebra::Vector& y) {
  std::vector<fem::BodyPlace> places;
  places.reserve(space.bodies.size());
  for (const fem::PlacedBody& placed : space.bodies) places.push_back(fem::place_of(space, placed, y));
  return places;
}

algebra::Vector with_kept_lengths(const fem::Space& space, const std::vector<NodalPoint>& points, algebra::Vector y) {
  const std::vector<fem::BodyPlace> places = body_places(space, y);
  const std::vector<Vector3d> normals = normals_of(points);
  std::vector<Vector3d> directors = normals;
  const auto rotation = [&](std::size_t node) { return Eigen::Map<Vector3d>(y.at(node).data() + 3); };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!rotation(i).isZero(0)) directors[i] = normals[i].norm() * (normals[i] + rotation(i)).normalized();
  fem::keep_angles(space, normals, directors);
  for (std::size_t i = 0; i < points.size(); ++i) rotation(i) = directors[i] - normals[i];
  for (std::size_t k = 0; k < places.size(); ++k) carry(space.bodies[k], places[k], points, y);
  space.continuity.apply(y);
  return y;
}

std::vector<NodalPoint> moved_points(std::vector<NodalPoint> points, const algebra::Vector& y) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector6 moved = node_values(y, i);
    points[i].phi += moved.head<3>();
    points[i].a3 += moved.tail<3>();
  }
  return points;
}

std::shared_ptr<const fem::Space> turned_space(const std::shared_ptr<const fem::Space>& space,
                                               const std::vector<NodalPoint>& points,
                                               const std::vector<NodalPoint>& moved,
                                               const std::vector<fem::BodyPlace>& places) {
  return fem::turned(space, normals_of(points), normals_of(moved), places);
}

std::vector<NodeSupport> remaining_supports(std::vector<NodeSupport> supports, const std::vector<NodalPoint>& points,
                                            const algebra::Vector& y) {
  for (std::size_t i = 0; i < supports.size(); ++i) {
    NodeSupport& support = supports[i];
    const Vector6 now = node_values(y, i);
    const Vector3d& a3 = points[i].a3;
    support.displacement_scale = std::max(support.displacement_scale, points[i].thickness);
    support.rotation_scale = std::max(support.rotation_scale, 1.0);
    for (auto& [direction, value] : support.displacement) value -= direction.dot(now.head<3>());
    if (prescribes_director(a3, a3 + now.tail<3>(), support)) continue;
    for (auto& [direction, value] : support.rotation) value -= direction.dot(now.tail<3>());
  }
  return supports;
}

void turn_body_loads(const fem::Space& space, const fem::Space& turned, const energy::Factors& factors,
                     algebra::Vector& load) {
  for (std::size_t k = 0; k < space.bodies.size(); ++k) {
    algebra::Vector before(load.layout(), 6), now(load.layout(), 6);
    fem::add_body_load(space, space.bodies[k], before);
    fem::add_body_load(turned, turned.bodies[k], now);
    const double factor = factors.load(space.bodies[k].body.factor);
    algebra::axpy(-factor, before, load);
    algebra::axpy(factor, now, load);
  }
}

}  // namespace plastron::assembly
