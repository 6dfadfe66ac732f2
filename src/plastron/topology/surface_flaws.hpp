// Flaws of a surface mesh as files have them: parts that are not joined, cells that occur twice or have a bad shape,
// and surfaces that pass through each other. The search needs no topology, so it also works for meshes without one.
#pragma once
#include <plastron/topology/space_mesh.hpp>

#include <string>
#include <vector>

namespace plastron::topology {

struct FlawLimits {
  /// Borders are not joined by mistake if their distance is below this part of the length of their edges; 0: no search.
  double gap = 0.05;
  std::vector<double> thickness{};  ///< of each region, to find cells nearer than that [m]; empty: no search
};

struct Flaw {
  std::string message;
  Vector3d where;  ///< first or worst place
  SurfaceError::About about = SurfaceError::About::cells;
};

/// One flaw of each kind, with the number of its occurrences.
struct SurfaceFlaws {
  std::vector<Flaw> errors;    ///< the mesh is not what its author means, or cannot be used
  std::vector<Flaw> warnings;  ///< the results may be bad
};

/// Errors: nodes that are not finite; cells with the same corners; degenerate or folded cells; gaps between borders;
/// borders that end on a cell or on a part of a side. Warnings: cells with an aspect or a ratio of normals above 2000;
/// cells that pass through each other or are nearer than their thickness without being neighbours.
SurfaceFlaws find_flaws(const SpaceMesh& mesh, const FlawLimits& limits);

// Its parts:

/// Checks each cell by itself.
void find_bad_cells(const SpaceMesh& mesh, SurfaceFlaws& flaws);
/// Finds borders that are near each other or near cells without being joined.
void find_gaps(const SpaceMesh& mesh, double gap, SurfaceFlaws& flaws);
/// Finds cells that are not neighbours and pass through each other, or are near one above the other.
void find_intersections(const SpaceMesh& mesh, const std::vector<double>& thickness, SurfaceFlaws& flaws);

}  // namespace plastron::topology
