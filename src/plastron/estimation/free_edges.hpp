// Edges at which no support fixes r, and their layer, which is thinner than the mesh. Where r . n is fixed, as at
// edges of symmetry, there is no twisting moment M_nt. At free edges M_nt vanishes within a layer
//     r . t = psi exp(-s / delta),     delta^2 = D_66 / S, isotropic e^2 / (12 k_s),
// s the distance from the edge. With wider cells M_nt has a non-zero value at the edge. With T = D_66, isotropic
// mu e^3 / 12, the layer's energy is 1/2 int T (psi'^2 + psi^2 / delta^2) ds = psi^2 T / (2 delta). Energy minus the
// work M_nt psi is least at psi = M_nt delta / T. The squared error in the energy norm is therefore M_nt^2 delta / T per
// length of edge, minus the share that the polynomials of a cell represent.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <vector>

namespace plastron::estimation {

/// A free side of an owned cell: points, unit tangents of the edge there, and the factors of M_nt^2 [1/N].
struct FreeEdge {
  std::size_t cell = 0;
  std::vector<Eigen::Vector2d> xi{};
  std::vector<geometry::Vector3d> tangent{};
  std::vector<double> weight{};
};

/// Returns the free edges of the owned cells in ascending order of cells, without edges where couples act. Empty at
/// degree 1, where edges have no nodes of their own (collective).
std::vector<FreeEdge> free_edges(const assembly::DiscreteShell& discrete);

}  // namespace plastron::estimation
