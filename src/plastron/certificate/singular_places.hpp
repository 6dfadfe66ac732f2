// Where stresses have no limit as the mesh is refined: corners of the shell, and points that carry a force.
//
// Near a corner the leading parts of Naghdi's operator are those of plane elasticity for the displacements in the tangent plane and for the rotation,
// and that of a membrane for the deflection (Roessle and Saendig, J. Elasticity 103, 2011, for plates). Each has bounded stresses up to an angle that depends on what either edge holds of
// it (Williams, J. Appl. Mech. 19, 1952): 180 degrees where both hold all of it or nothing, 63 (in elasticity at nu = 0.3) or 90 (of the deflection)
// where one holds all of it and the other nothing, 90 where an edge holds one component of two.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <string>
#include <vector>

namespace plastron::certificate {

struct Summary;

struct SingularPlace {
  std::string what{};                                  ///< in words
  Eigen::Vector2d at = Eigen::Vector2d::Zero();        ///< in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the undeformed mid-surface [m]
  double radius = 0;  ///< within which stresses are left out of rankings: the thickness there [m]
};

/// In an order of places, the same on every rank (collective). `summary`: of the solution, for what points carry.
std::vector<SingularPlace> singular_places(const assembly::DiscreteShell& discrete, const Summary& summary);

}  // namespace plastron::certificate
