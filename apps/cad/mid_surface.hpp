// Thin solids: pairs of opposite faces at one distance, the thickness. The faces of one side are meshed, and the nodes are
// moved to the middle.
#pragma once
#include "sampling.hpp"

#include <vector>

namespace plastron::cad {

/// The faces of a part with the faces of one side in the place of each thin solid, and their thickness. Returns all faces if no solid
/// is thin. Throws PartError, with numbers of faces, for a solid that is thin in places and no sheet, and for a thick one beside
/// thin ones.
std::vector<LabelledFace> with_sides_of_sheets(const PartFile& part);

/// Moves the nodes on such sides by half of the thickness against the normals of the faces; where faces meet at an angle, to the
/// place that has this distance from all of them. Throws PartError if this leaves the solids.
void move_to_middle(const PartFile& part, const JoinedPart& joined, SampledMesh& mesh);

}  // namespace plastron::cad
