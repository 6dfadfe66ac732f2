// The gaps of a problem's shell against its obstacles.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/problem/problem.hpp>

#include <cmath>

namespace plastron::problem {

/// Returns the obstacles for (M16).
inline assembly::RigidObstacles rigid_obstacles(const Problem& problem) {
  return {.all = problem.obstacles, .face_scale = problem.face_scale, .are_linear = problem.linearisation.once};
}

/// Whether the supports fix the row's face inside its obstacle, where no bound can move it out. The limit is the
/// rounding of the gap's terms, for any unit of length.
inline bool is_held_inside(const assembly::NodalCoordinates& coordinates, const assembly::NodalPoint& point,
                           const assembly::ContactRow& row) {
  if (row.is_touchable() || row.is_left_out) return false;
  const double initial = coordinates.gaps[static_cast<std::size_t>(row.obstacle)][row.node].initial;
  return row.bound_gap < -1e-12 * (point.phi.norm() + point.thickness + std::abs(initial));
}

}  // namespace plastron::problem
