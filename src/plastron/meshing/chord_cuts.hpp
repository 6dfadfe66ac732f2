// The chords of a mesh of quadrilaterals: rows of cells that are neighbours across opposite sides. If all cells of a
// chord are divided along it, the mesh conforms without hanging nodes. Chords of the coarse mesh are cut before cells
// are divided one by one (docs/methods/accuracy.md): layers along edges, and edges of contact zones along rows of cells,
// need cells that are narrow in one direction only.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/fem/surface.hpp>

#include <array>
#include <limits>
#include <span>
#include <vector>

namespace plastron::meshing {

struct Chords {
  /// Chords through each cell: the one across its direction xi_1, which cuts the sides xi_2 = 0 and 1, and the one
  /// across xi_2.
  std::vector<std::array<int, 2>> of_cell{};
  int count = 0;
};

/// Returns the chords, numbered by their first cells. Precondition: quadrilaterals. Their sides run the same way in
/// neighbours where this matters.
Chords chords(const mesh::CoarseMesh& mesh);

/// Why and where chords are cut.
struct ChordTask {
  std::span<const double> shares;  ///< part of the goals' errors in each owned cell
  const estimation::Estimates& estimates;
  double share = 0;  ///< part of the whole error that must be divided
  /// Part of the whole error in the cells marked one by one, for each cell that their division adds.
  double per_cell = 0;
  bool halves_only = false;  ///< points that are fixed must stay nodes
  bool are_met = false;      ///< the goals are met: only unjudged cells are a reason to cut
  /// Only the chords of cells at edges of contact zones are cut, or none if dividing these cells is much cheaper.
  bool at_edges = false;
  double most_slender = std::numeric_limits<double>::infinity();  ///< length of a part over its width, at most
};

/// Returns cuts of the coarse cells, see fem::MeshSequence::cut. Empty where cells are already divided or single cells
/// have more worth (collective).
std::vector<mesh::Cuts> chord_cuts(const fem::Space& space, const fem::Surface& surface, const ChordTask& task);

/// Returns cuts that halve these owned cells along their chords, as chord_cuts() does. Empty where the division of the
/// cells adds fewer cells (collective).
std::vector<mesh::Cuts> cuts_through(const fem::Space& space, const fem::Surface& surface,
                                     std::span<const std::size_t> cells,
                                     double most_slender = std::numeric_limits<double>::infinity());

}  // namespace plastron::meshing
