// The gap of a problem's shell against its obstacle.
#pragma once
#include <plastron/assembly/nodal_coordinates.hpp>
#include <plastron/computation/problem.hpp>

#include <cmath>

namespace plastron::computation {

/// (M16) for the problem's obstacle and face; empty without obstacle.
inline assembly::GapFunction gap_function(const Problem& problem) {
  if (!problem.obstacle) return {};
  return [o = *problem.obstacle](const Eigen::Vector3d& phi, const Eigen::Vector3d& a3, double thickness) {
    obstacle::Gap gap = obstacle::gap_at(o.half_space, o.face, phi, a3, o.face_scale * thickness);
    gap.initial -= o.raised;
    return gap;
  };
}

/// The supports hold the touching face inside of the obstacle at a node, and no bound can move it out. What its gap is
/// summed from leaves rounding, whatever the unit of length.
inline bool is_held_inside(const assembly::NodalCoordinates& coordinates, const assembly::NodalPoint& point,
                           std::size_t node) {
  if (coordinates.touchable[node] || coordinates.gaps.empty()) return false;
  const double terms = point.phi.norm() + point.thickness + std::abs(coordinates.gaps[node].initial);
  return coordinates.bound_gap[node] < -1e-12 * terms;
}

}  // namespace plastron::computation
