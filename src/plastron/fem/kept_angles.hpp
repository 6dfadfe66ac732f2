// Kinks with finite rotations: directors keep their angle, d_1 . d_2 = a_31 . a_32. The derivative of this equation is the condition
// of small rotations (fem/kinks.hpp) for the turned directors, with the axis d_1 x d_2. At a branch each director keeps its angle
// with one other that is not parallel. A director that keeps its angles with two others follows from them.
#pragma once
#include <plastron/fem/space.hpp>

#include <span>
#include <vector>

namespace plastron::fem {

/// Returns the row of each local node at a kink of the space after its directors have turned from `normals` to `directors`.
std::vector<constraints::Row> turned_kinks(const Space& space, std::span<const Eigen::Vector3d> normals,
                                           std::span<const Eigen::Vector3d> directors);

/// Turns directors of local nodes at kinks so that they keep their angles with the directors of other nodes. Lengths stay.
void keep_angles(const Space& space, std::span<const Eigen::Vector3d> normals, std::span<Eigen::Vector3d> directors);

}  // namespace plastron::fem
