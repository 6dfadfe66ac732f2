// The gaps of a problem's shell against its obstacles.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/problem.hpp>

#include <cmath>

namespace plastron::computation {

/// For (M16).
inline assembly::RigidObstacles rigid_obstacles(const Problem& problem) {
  return {.all = problem.obstacles, .face_scale = problem.face_scale, .are_linear = problem.linearisation.once};
}

/// The supports hold the row's face inside of its obstacle, and no bound can move it out. What its gap is summed from leaves
/// rounding, whatever the unit of length.
inline bool is_held_inside(const assembly::NodalCoordinates& coordinates, const assembly::NodalPoint& point,
                           const assembly::ContactRow& row) {
  if (row.is_touchable() || row.is_left_out) return false;
  const double initial = coordinates.gaps[static_cast<std::size_t>(row.obstacle)][row.node].initial;
  return row.bound_gap < -1e-12 * (point.phi.norm() + point.thickness + std::abs(initial));
}

}  // namespace plastron::computation
