// Places where stresses have no limit under refinement: corners of the shell, points with a force, and lines and points of
// contact, where the reaction is concentrated (docs/model.md, section 6).
//
// Near a corner the leading parts of Naghdi's operator are plane elasticity for the displacements in the tangent
// plane and for the rotation. For the deflection it is a membrane (Roessle and Saendig, J. Elasticity 103, 2011, for
// plates). Stresses of each part are bounded up to an angle that depends on the constraints of both edges (Williams,
// J. Appl. Mech. 19, 1952):
// - 180 degrees if both edges fix all components or both none;
// - 63 degrees (elasticity at nu = 0.3) or 90 degrees (deflection) if one fixes all and the other none;
// - 90 degrees if an edge fixes one component of two.
#pragma once
#include <plastron/solution/nodal_solution.hpp>
#include <plastron/solution/summary.hpp>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace plastron::recovery {

struct SingularPlace {
  std::string what{};                                  ///< description in words
  Eigen::Vector2d at = Eigen::Vector2d::Zero();        ///< in Omega
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the undeformed mid-surface [m]
  double radius = 0;  ///< radius within which rankings leave stresses out: the thickness there [m]
  /// Further positions of a place that is no point, such as the nodes of a line of contact [m].
  std::vector<Eigen::Vector3d> others{};

  bool is_near(const Eigen::Vector3d& point) const {
    return (point - position).norm() < radius ||
           std::ranges::any_of(others, [&](const Eigen::Vector3d& other) { return (point - other).norm() < radius; });
  }
};

/// Returns whether stresses at a point of the undeformed mid-surface do not count, because a place is near.
inline bool is_singular(const Eigen::Vector3d& position, std::span<const SingularPlace> places) {
  return std::ranges::any_of(places, [&](const SingularPlace& place) { return place.is_near(position); });
}

/// Returns the places in an order that is the same on every rank (collective). `summary`: totals of the solution,
/// with the forces of points.
std::vector<SingularPlace> singular_places(const assembly::DiscreteShell& discrete,
                                           const solution::NodalSolution& solution, const solution::Summary& summary);

}  // namespace plastron::recovery
