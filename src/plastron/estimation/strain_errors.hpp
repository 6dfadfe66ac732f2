// Estimated errors of a field's strains, cell by cell. Resultants smoothed over patches
// (recovery/resultant_patches.hpp) converge one order faster than the element's resultants, so their difference
// estimates the error. Tied strains (M22) have a second error: they differ from the strains of the displacements. It
// affects forces and is stored separately. The identities are in docs/methods/estimates.md. Profiles show the direction
// in which a cell needs refinement, and where.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/estimation/free_edges.hpp>
#include <plastron/recovery/resultant_patches.hpp>
#include <plastron/solution/nodal_solution.hpp>

#include <memory>
#include <vector>

namespace plastron::estimation {

using energy::CellStrain;

/// Rows are the quadrature points of a cell.
struct StrainErrors {
  CellStrain error;            ///< recovered strains minus the element's strains
  CellStrain stresses;         ///< recovered resultants times area
  CellStrain incompatibility;  ///< strains of the displacements minus the element's tied strains; zero without tying
  /// M_nt on free edges times the root of its weight (free_edges.hpp). Products are the energies of layers missing in
  /// the mesh.
  Eigen::VectorXd edge_twist{};
  bool has_patch = false;  ///< False: `error` comes from the element's own points alone and is too small
};

/// Computes strain errors of several fields on the same mesh.
class StrainRecovery {
 public:
  /// `edges` are the shell's free edges. Both arguments must outlive this object.
  StrainRecovery(const assembly::DiscreteShell& discrete, const std::vector<FreeEdge>& edges)
      : discrete_(discrete), edges_(edges) {}
  /// Returns the errors of the solution in the owned cells. It comes first, and decides the patches (collective).
  std::vector<StrainErrors> of_solution(const solution::NodalSolution& solution);
  /// Returns the errors of a motion y, a dual solution (block 6, current ghosts) (collective).
  std::vector<StrainErrors> of_motion(const algebra::Vector& y) const;

 private:
  std::vector<StrainErrors> errors(assembly::FieldKind kind, const algebra::Vector& y,
                                   const recovery::ResultantPatches& resultants) const;

  const assembly::DiscreteShell& discrete_;
  const std::vector<FreeEdge>& edges_;
  std::shared_ptr<const recovery::Patches> patches_{};  ///< made for the first field
};

/// int e_u : C : e_z over an owned cell, with the layers at its free edges.
double energy_product(const energy::ShellOperator& shell, std::size_t cell, const StrainErrors& u,
                      const StrainErrors& z);
/// int sigma*(u) : incompatibility(z).
double tying_product(const StrainErrors& u, const StrainErrors& z);

/// Returns the profile of each quadrilateral; empty for triangles. The error is expanded in products of Legendre
/// polynomials P_i(xi_1) P_j(xi_2), orthonormal at the quadrature points. The part i^2 / (i^2 + j^2) of each squared
/// coefficient counts as a change along xi_1, and half of a constant.
std::vector<ErrorProfile> error_profiles(const energy::ShellOperator& shell, const std::vector<StrainErrors>& errors);

}  // namespace plastron::estimation
