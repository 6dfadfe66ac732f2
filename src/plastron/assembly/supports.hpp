// Supports: which components of (u, r) a boundary prescribes, or which of u a point, and to which values.
#pragma once
#include <plastron/geometry/expression.hpp>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace plastron::assembly {

enum class Unknown { displacement, rotation };

/// Directions in which a component is taken. `conormal` is the unit vector tangent to the shell and normal to the
/// boundary curve, outward; `tangent` runs along the curve, normal is a_3.
enum class Direction { x, y, z, conormal, tangent, normal };

/// One prescribed component, u.d = value [m] or r.d = value [rad].
struct PrescribedComponent {
  Unknown unknown = Unknown::displacement;
  Direction direction = Direction::x;
  geometry::Expression value{};
};

/// A point has no boundary and prescribes Cartesian components of u alone; it is a node of every mesh (fem/kept_nodes.hpp).
struct Support {
  std::string boundary{};
  std::vector<PrescribedComponent> components{};
  bool symmetry = false;  ///< the components came from "symmetry": the edge must lie in a plane normal to the shell
  std::optional<Eigen::Vector2d> point{};  ///< in Omega
};

}  // namespace plastron::assembly
