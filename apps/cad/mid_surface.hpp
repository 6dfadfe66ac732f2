// Thin solids: pairs of opposite faces at one distance, the thickness. The faces of one side are meshed, and the nodes are
// moved to the middle.
#pragma once
#include "sampling.hpp"

#include <string>
#include <vector>

namespace plastron::cad {

/// A side of a thin solid.
struct ThinSide {
  std::vector<LabelledFace> faces;
  double thickness = 0;  ///< distance of the opposite faces [mm]
};

/// The sides whose middles are the shell: one of each solid with pairs of opposite faces. Empty if no solid is thin. Throws
/// PartError, with the faces, for a solid that is thin in part only and for branches.
std::vector<ThinSide> thin_sides(const PartFile& part);

/// Moves the nodes of a mesh of such sides by half of the thickness against their normals; where faces meet at an angle, to
/// the place that has this distance from all of them. `thickness` by face of the joined part [mm].
void move_to_middle(SampledMesh& mesh, const std::vector<double>& thickness);

}  // namespace plastron::cad
