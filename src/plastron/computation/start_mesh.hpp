// The coarsest mesh of a computation, the same for all commands: plain cells, or rows of long thin ones along the edges of the shell
// with cells between them that the shell's thickness and curvature ask for (docs/methods/layers.md).
#pragma once
#include <plastron/computation/layer_widths.hpp>
#include <plastron/computation/problem.hpp>
#include <plastron/fem/layered_mesh.hpp>

#include <optional>
#include <string>
#include <vector>

namespace plastron::computation {

struct StartMesh {
  fem::CoarseMesh coarse;
  std::vector<EdgeLayer> rows{};  ///< the layers that have rows along their edges
  bool has_narrow_rows = false;   ///< a second row between each and the edge, for accuracies that corners decide
  std::string no_rows{};          ///< why there are none although the problem asks for them; empty otherwise
};

/// Throws fem::DomainError where the domain cannot be meshed.
StartMesh start_mesh(const Problem& problem);

/// The degree with which the fewest unknowns were wanted for an error of 1e-3: high where the solution is smooth between layers, low
/// where it has the edge of a contact zone.
int recommended_degree(const Problem& problem);

/// Nodes of the mesh when it is refined uniformly, before edges are joined.
std::int64_t node_count(const fem::CoarseMesh& coarse, int degree, int refinements);

/// What the start mesh is, in a sentence or two for the user; empty where the problem asks for no rows.
std::string describe(const StartMesh& mesh, const Problem& problem);

}  // namespace plastron::computation
