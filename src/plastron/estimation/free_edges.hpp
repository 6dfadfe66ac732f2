// Edges at which nothing holds r, and the layer there that a mesh does not have. Where r . n is held, as at edges of symmetry, there is no
// twisting moment M_nt; at free edges it goes to zero within a layer r . t = psi exp(-s / delta), s the distance from the edge and
// delta^2 = e^2 / (12 k_s). With wider cells M_nt ends at some value. With T = mu e^3 / 12 the layer's energy
// 1/2 int T (psi'^2 + psi^2 / delta^2) ds = psi^2 T / (2 delta) is least against the work M_nt psi at psi = M_nt delta / T, so that the
// squared error in the energy norm is M_nt^2 delta / T by length of edge, less the share that the polynomials of a cell can have of it.
#pragma once
#include <plastron/assembly/discrete_shell.hpp>

#include <vector>

namespace plastron::estimation {

/// A side of an owned cell: points, unit tangents of the edge there, and what M_nt^2 is multiplied with [1/N].
struct FreeEdge {
  std::size_t cell = 0;
  std::vector<Eigen::Vector2d> xi{};
  std::vector<geometry::Vector3d> tangent{};
  std::vector<double> weight{};
};

/// Those of the owned cells, in ascending order of cells, without those where couples act; none at degree 1, whose edges have no nodes of
/// their own (collective).
std::vector<FreeEdge> free_edges(const assembly::DiscreteShell& discrete);

}  // namespace plastron::estimation
