// What recovery says of the error of a field's strains, cell by cell: resultants smoothed over patches (recovery/resultant_patches.hpp)
// converge an order faster than those of the element, so their difference stands for the error. Tied strains (M22) err in another way,
// too: they are not those of the displacements, which matters to forces and is kept beside it. docs/methods/estimates.md has the identities.
#pragma once
#include <plastron/certificate/certificate.hpp>
#include <plastron/estimation/free_edges.hpp>
#include <plastron/recovery/patches.hpp>

#include <memory>
#include <vector>

namespace plastron::estimation {

using assembly::CellStrain;

/// Rows are the quadrature points of a cell.
struct StrainErrors {
  CellStrain error;            ///< recovered strains minus those of the element
  CellStrain stresses;         ///< recovered resultants times area
  CellStrain incompatibility;  ///< strains of the displacements minus the tied ones of the element; zero without tying
  /// M_nt on free edges times the root of its weight (free_edges.hpp): products are those of the layers that the mesh does not have.
  Eigen::VectorXd edge_twist{};
  bool has_patch = false;  ///< without, `error` is what the element's own points tell, which is too little
};

/// Of one field after the other on the same mesh.
class StrainRecovery {
 public:
  /// `edges` are the free ones of the shell. Both must outlive this object.
  StrainRecovery(const assembly::DiscreteShell& discrete, const std::vector<FreeEdge>& edges)
      : discrete_(discrete), edges_(edges) {}
  /// Of the owned cells, for the field y (block 6, current ghosts) (collective).
  std::vector<StrainErrors> operator()(const algebra::Vector& y);

 private:
  const assembly::DiscreteShell& discrete_;
  const std::vector<FreeEdge>& edges_;
  std::shared_ptr<const recovery::Patches> patches_{};  ///< made for the first field
};

/// int e_u : C : e_z over an owned cell, with the layers at its free edges.
double energy_product(const assembly::ShellOperator& shell, std::size_t cell, const StrainErrors& u,
                      const StrainErrors& z);
/// int sigma*(u) : incompatibility(z).
double tying_product(const StrainErrors& u, const StrainErrors& z);

}  // namespace plastron::estimation
