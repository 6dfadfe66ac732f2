// Which chords of the coarse mesh to cut before cells are divided one by one (docs/methods/accuracy.md): layers along edges and edges of contact
// zones along rows of cells want cells that are narrow in one direction only.
#pragma once
#include <plastron/estimation/estimates.hpp>
#include <plastron/fem/surface.hpp>

#include <span>
#include <vector>

namespace plastron::computation {

struct ChordTask {
  std::span<const double> shares;  ///< of the owned cells, what each has of the goals' errors
  const estimation::Estimates& estimates;
  double share = 0;          ///< of the whole that is to be divided
  double per_cell = 0;       ///< of the whole that cells marked one by one have for each cell that dividing them adds
  bool halves_only = false;  ///< points that are held have to stay nodes
  bool are_met = false;      ///< the goals: but for cells that nothing judges there is no reason to cut
  /// Only the chords of cells at edges of contact zones are to be cut, or none if to divide these cells is much cheaper.
  bool at_edges = false;
};

/// Cuts of the coarse cells, see fem::MeshSequence::cut; none where cells are divided already or single ones are worth more (collective).
std::vector<fem::Cuts> chord_cuts(const fem::Space& space, const fem::Surface& surface, const ChordTask& task);

}  // namespace plastron::computation
