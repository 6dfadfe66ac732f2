// Both sides of Falk's estimate (docs/research/convergence.md) with actual fields, in the energy norm, where M = alpha = 1:
//
//   |U - U_h|^2 <= |U - W_h|^2 + 2 <l - A U, U - W_h + U_h - W>      <= |U - W_h|^2 + 2 |eta|_0 (|g(W_h) - g(U)|_0 + |g(W) - g(U_h)|_0)
//
// U: the reference. W_h in K_h: its nodal interpolant. W in K: U_h, its penetration at the reference's nodes closed. <l - A U, V> is
// minus the work of the obstacles' reaction on V. Without contact it is Cea's lemma.
#pragma once
#include <plastron/computation/result.hpp>
#include <plastron/problem/problem.hpp>
#include <research/study/nested_meshes.hpp>

#include <mpi.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace plastron::study {

/// The field of K_h whose nodal coordinates (assembly/nodal_coordinates.hpp) are those of `y` moved to the nearest bound where they are
/// outside: gaps that are negative are closed, supports kept, r made tangent. A field of K_h stays the same. Block 6 with valid
/// ghosts; y is not read at hanging nodes and joined edges. Precondition: no rigid bodies, and no relaxed formulation. (collective)
algebra::Vector nearest_admissible(const assembly::DiscreteShell& discrete, const algebra::Vector& y);

/// The part in V_h of a difference of fields: zero at supports, r tangent. Same precondition. (collective)
algebra::Vector virtual_part(const assembly::DiscreteShell& discrete, const algebra::Vector& difference);

/// A solution on one mesh, with the data that restore its discretisation.
struct CoarseSolution {
  std::shared_ptr<const fem::Space> space;
  assembly::State state;
  algebra::Vector y;  ///< (u, r), block 6
};

/// A solution as the reference's mesh sees it.
struct SeenSolution {
  const algebra::Vector& y;                        ///< carried to the reference's nodes
  const std::vector<energy::CellStrain>& strains;  ///< of its own mesh, at the reference's quadrature points
};

/// All but the penetrations in energies [J]: the estimate says error <= interpolation + 2 reaction.
struct FalkTerms {
  double error = 0;          ///< |U - U_h|_a^2, of strains each of its own mesh
  double interpolation = 0;  ///< |U - W_h|_a^2, likewise
  double reaction = 0;       ///< <eta, g(W_h) - g(U)> + <eta, g(W) - g(U_h)> by the nodal quadrature
  double l2_reaction = 0;    ///< |eta|_0 (|g(W_h) - g(U)|_0 + |g(W) - g(U_h)|_0), nodal quadrature
  /// Differences of forms, loads and spaces between the two meshes (tying, quadrature, tangency at nodes: Strang's lemmas),
  /// with sign; added to the reaction.
  double consistency = 0;
};

/// Why the estimate cannot be evaluated for the problem; empty if it can.
std::string why_without_falk(const problem::Problem& problem);

/// The terms of every coarse solution, coarsest first, on the meshes of the problem. Precondition: why_without_falk() is empty. (collective)
std::vector<FalkTerms> falk_terms(const problem::Problem& problem, const computation::Solution& reference,
                                  const ReferenceStrains& reference_strains, const SeenSolution& seen_reference,
                                  std::span<const CoarseSolution> coarse, std::span<const SeenSolution> seen,
                                  MPI_Comm comm);

}  // namespace plastron::study
