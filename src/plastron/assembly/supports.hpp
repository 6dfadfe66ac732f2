// Supports: components of (u, r) that a boundary prescribes, or components of u that a point prescribes, and their
// values.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plastron::assembly {

enum class Unknown { displacement, rotation };

/// Directions of a component. `conormal` is the unit vector tangent to the shell and normal to the
/// boundary curve, outward; `tangent` runs along the curve, normal is a_3. The others are those of Support::axes and
/// Support::direction.
enum class Direction { x, y, z, conormal, tangent, normal, axis_1, axis_2, axis_3, given };

/// One prescribed component, u.d = value [m] or r.d = value [rad].
struct PrescribedComponent {
  Unknown unknown = Unknown::displacement;
  Direction direction = Direction::x;
  geometry::Expression value{};
};

/// A support of a boundary or a point. A point has no boundary and prescribes Cartesian components of u alone. It is a
/// node of every mesh (mesh::kept_nodes).
struct Support {
  std::string boundary{};
  std::vector<PrescribedComponent> components{};
  int factor = -1;        ///< see energy::Factors::named
  bool symmetry = false;  ///< the components come from "symmetry": the edge must lie in a plane normal to the shell
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< orthonormal, in the rows
  std::array<geometry::Expression, 3> direction{};     ///< of Direction::given; any length except 0
  std::optional<Eigen::Vector2d> point{};              ///< in Omega
  std::optional<Eigen::Vector3d> point_in_space{};     ///< if given, `point` is the nearest node [m]
};

/// Returns the unit vector of a direction that depends on the place alone; nothing for those that belong to a boundary or the shell.
std::optional<Eigen::Vector3d> direction_at(const Support& support, Direction direction, const geometry::Place& place);

}  // namespace plastron::assembly
