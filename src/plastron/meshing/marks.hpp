// Decides from the estimated errors of the goals on the next mesh: which chords are cut, or which cells are divided or
// joined (docs/methods/accuracy.md).
#pragma once
#include <plastron/estimation/goal_record.hpp>
#include <plastron/fem/space.hpp>
#include <plastron/mesh/coarse_mesh.hpp>
#include <plastron/problem/problem.hpp>

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plastron::meshing {

/// Returns for each owned cell the largest error that any goal has in it, relative to the allowed error.
std::vector<double> error_indicators(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                                     const estimation::Estimates& estimates);

/// Returns the largest threshold above which cells contain `share` of the whole, to within a hundredth. The tolerance
/// ensures that rounding does not separate cells that are equal by symmetry (collective).
double error_threshold(const std::vector<double>& indicators, double share, MPI_Comm comm);

/// Returns marks of the owned cells for fem::MeshSequence::refine. Divided are the cells that contain `share` of all
/// errors, with each goal's error relative to its allowed error (Doerfler, SIAM J. Numer. Anal. 33, 1996), and unjudged
/// cells. Cells are joined again if their part then stays negligible (collective).
std::vector<signed char> marks(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                               const estimation::Estimates& estimates, double share);

/// Returns the part of the errors that lies in the cells to divide. `excess` is the worst goal's error relative to its
/// allowed error.
double share_to_divide(double excess);

/// Data for the decision on the next mesh.
struct NextMeshTask {
  const std::vector<estimation::GoalRecord>& goals;
  const std::optional<estimation::Estimates>& estimates;
  double excess = 1;                       ///< error of the worst goal relative to its allowed error
  bool follows_errors = false;             ///< false: all cells are divided. True only with estimates
  bool may_join = false;                   ///< whether cells may be joined
  bool wants_edges = false;                ///< only cells at edges of contact zones are divided or cut
  std::span<const std::size_t> entered{};  ///< owned cells that an obstacle enters between their nodes
  bool lacks_contact = false;              ///< the shell has missed an obstacle: errors are those of another state
  bool has_lost_stiffness = false;         ///< some motion has lost its stiffness: cuts leave no slender cells
};

struct NextMesh {
  std::vector<mesh::Cuts> cuts{};    ///< cuts of the coarse cells, see fem::MeshSequence::cut; if empty, `marks` count
  std::vector<signed char> marks{};  ///< marks of the owned cells, see fem::MeshSequence::refine
  std::int64_t added_cells = 0;
  bool has_joined = false;  ///< whether cells are joined
};

/// Decides on the next mesh (collective).
NextMesh next_mesh(const problem::Problem& problem, const fem::Space& space, const NextMeshTask& task);

}  // namespace plastron::meshing
