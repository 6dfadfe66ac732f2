// A shell that stands on an edge touches with both faces.
#pragma once
#include <plastron/problem/problem.hpp>

namespace plastron::problem {

/// Lets both faces touch an obstacle that is nearest to an edge on which the shell stands: there a_3 is at right angles to the
/// obstacle's normal, within 6 degrees, and both faces are equally near. Each face then has its own bound (M16). Obstacles that a
/// force presses stay as they are. Throws mesh::DomainError of the mesh.
void let_both_faces_touch(Problem& problem);

}  // namespace plastron::problem
