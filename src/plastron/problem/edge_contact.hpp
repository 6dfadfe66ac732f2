// Obstacles for one face or for both: a shell that stands on an edge touches with both faces.
#pragma once
#include <plastron/problem/problem.hpp>

#include <array>

namespace plastron::problem {

/// Ends of the names of an obstacle that both faces may touch.
inline constexpr const char *of_lower_face = ", lower face", *of_upper_face = ", upper face";
/// Returns an obstacle that both faces may touch as two obstacles: for the lower face, and for the upper one.
std::array<obstacle::Obstacle, 2> for_both_faces(const obstacle::Obstacle& body);

/// Lets both faces touch an obstacle that is nearest to an edge on which the shell stands: there a_3 is at right angles to the
/// obstacle's normal, within 6 degrees, and both faces are equally near. Each face then has its own bound (M16). Obstacles that a
/// force presses stay as they are. Throws mesh::DomainError of the mesh.
void let_both_faces_touch(Problem& problem);

}  // namespace plastron::problem
