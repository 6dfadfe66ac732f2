// Contact by the sides of folds. At a fold one node decides the displacement of all sides and has the contact row of the
// nearest face. The cells that touch are those of this face: the reaction belongs to their nodes.
#pragma once
#include <plastron/solution/nodal_solution.hpp>

namespace plastron::solution {

/// Contact of each local node's own face, with valid ghosts; block: number of obstacles, at least 1.
struct ContactFaces {
  algebra::Vector touching;  ///< 1 where the face touches, else 0
  algebra::Vector pressure;  ///< eta over NodalPoint::side_weight [Pa]
};

/// Returns the solution's contact by faces (collective). Without folds it is the solution's own.
ContactFaces contact_faces(const assembly::DiscreteShell& discrete, const NodalSolution& solution);

/// Divides a density per NodalPoint::weight of the deciding nodes among the sides with the nearest faces (collective).
void give_to_faces(const assembly::DiscreteShell& discrete, algebra::Vector& density);

}  // namespace plastron::solution
