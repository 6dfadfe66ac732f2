// Selects chords of the coarse mesh to cut before cells are divided one by one (docs/methods/accuracy.md). Layers along
// edges, and edges of contact zones along rows of cells, need cells that are narrow in one direction only.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/fem/surface.hpp>

#include <span>
#include <vector>

namespace plastron::meshing {

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
};

/// Returns cuts of the coarse cells, see fem::MeshSequence::cut. Empty where cells are already divided or single cells
/// have more worth (collective).
std::vector<fem::Cuts> chord_cuts(const fem::Space& space, const fem::Surface& surface, const ChordTask& task);

}  // namespace plastron::meshing
