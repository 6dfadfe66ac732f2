// Thin solids: pairs of opposite faces at one distance, the thickness. The faces of one side are meshed, and the nodes are
// moved to the middle.
#pragma once
#include "sampling.hpp"

#include <vector>

namespace plastron::cad {

/// The faces that are meshed in the place of thin solids.
struct SheetSides {
  std::vector<LabelledFace> faces;
  int joints = 0;      ///< edges at which a rib was extended to the middle of the sheet that it meets
  double overlap = 0;  ///< volume that sheets have in common there, by area times thickness [mm^3]
};

/// Returns the faces of a part with the faces of one side in the place of each thin solid, and their thickness. Where a plane sheet
/// ends on another one, its face lies in its middle already and reaches the face of the other one that is meshed, so that a
/// T-joint is left. Returns all faces if no solid is thin. Throws PartError, with numbers of faces, for a solid that is thin
/// in places and no sheet, and for a thick one beside thin ones.
SheetSides with_sides_of_sheets(const PartFile& part);

/// Moves the nodes on such sides to the middle, against the normals of the faces; where faces meet at an angle, to the
/// place that has its distance from all of them. Throws PartError if this leaves the solids.
void move_to_middle(const PartFile& part, const JoinedPart& joined, SampledMesh& mesh);

}  // namespace plastron::cad
