// Elastic foundations and springs (M32): a foundation is under an area or along edges, a spring at a point or on a rigid body. It
// resists the motion w = u + z r of the material at the height z with the forces -K w, and a shear layer resists the gradient of w . a_3
// (Pasternak). With finite rotations, too, K and a_3 are those of the reference. A spring on a body resists its motion (d, theta) with
// the force -K d and a couple of the energy 1/2 theta . K_r theta; with finite rotations theta is its rotation vector, shorter than pi.
#pragma once
#include <plastron/element/formulation.hpp>
#include <plastron/energy/loads.hpp>
#include <plastron/energy/term.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plastron::energy {

/// Stiffnesses are per area [N/m^3], per length of a boundary [N/m^2], or those of a spring [N/m, N m/rad].
struct Foundation {
  std::string name{};
  std::vector<std::string> regions{};                  ///< regions of the surface; empty: all of it
  std::vector<std::string> boundaries{};               ///< if given, the foundation is along these
  std::optional<Eigen::Vector2d> point{};              ///< if given, a spring at this point of Omega
  std::optional<Eigen::Vector3d> point_in_space{};     ///< if given, `point` is the nearest one [m]
  std::string body{};                                  ///< if given, a spring on this rigid body
  geometry::Expression normal{};                       ///< k_n along a_3
  geometry::Expression tangential{};                   ///< k_t in the tangent plane
  VectorExpression stiffness{};                        ///< along the three `axes`
  VectorExpression rotation{};                         ///< likewise of the rotation of a body
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< orthonormal, in the rows
  geometry::Expression shear{};                        ///< G of the shear layer, on areas alone [N/m]
  double height = 0;                                   ///< z / e: -1/2, 0 or 1/2

  bool is_spring() const { return point || point_in_space || !body.empty(); }
  bool is_under_area() const { return !is_spring() && boundaries.empty(); }
  bool acts_in(const std::string& region) const {
    return regions.empty() || std::ranges::find(regions, region) != regions.end();
  }
};

/// Returns the term of a foundation; null if all its stiffnesses are 0 (collective). Throws LoadError on all ranks together where a
/// stiffness is negative or not finite, or where the shell has no such region, boundary or body.
std::shared_ptr<const Term> foundation_term(const ShellOperator& shell, const Foundation& foundation,
                                            element::Rotations rotations = element::Rotations::small);

/// Returns -K w of a foundation under an area at points of an owned cell, without the shear layer. `values`: (u, r) in the rows.
std::vector<Eigen::Vector3d> tractions(const ShellOperator& shell, const Foundation& foundation, std::size_t cell,
                                       const std::vector<Vector2d>& xi, const element::CellField& values);

}  // namespace plastron::energy
