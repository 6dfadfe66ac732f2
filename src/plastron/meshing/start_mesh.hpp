// The coarsest mesh of a computation, the same for all commands: plain cells, or rows of long thin cells along the
// edges of the shell. The size of the cells between the rows follows from the shell's thickness and curvature
// (docs/methods/layers.md).
#pragma once
#include <plastron/meshing/layer_widths.hpp>
#include <plastron/meshing/layered_mesh.hpp>
#include <plastron/problem/problem.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::meshing {

struct StartMesh {
  mesh::CoarseMesh coarse;
  std::vector<EdgeLayer> rows{};  ///< the layers that have rows along their edges
  bool has_narrow_rows = false;   ///< a second row between each row and the edge, for accuracies that corners determine
  std::string no_rows{};          ///< reason why there are no rows although the problem requests them; empty otherwise
};

/// Returns the start mesh, with the imperfections. Throws mesh::DomainError where the domain cannot be meshed or a mode belongs
/// to another domain.
StartMesh start_mesh(const problem::Problem& problem);

/// Whether all cells of a problem with an accuracy are divided, or none. The problem may request this, and triangles
/// cannot be divided one by one.
bool is_refined_evenly(const problem::Problem& problem);

/// Returns the degree that needed the fewest unknowns for an error of 1e-3. It is high where the solution is smooth
/// between layers, low where it has the edge of a contact zone.
int recommended_degree(const problem::Problem& problem);

/// Number of nodes of the mesh after uniform refinement, before edges are joined.
std::int64_t node_count(const mesh::CoarseMesh& coarse, int degree, int refinements);

/// Returns a description of the start mesh for the user, in a sentence or two; empty where the problem requests no
/// rows.
std::string describe(const StartMesh& mesh, const problem::Problem& problem);

}  // namespace plastron::meshing
