// Thin solids as sheets: opposite faces at one distance, the thickness. The faces of one side of each sheet are meshed.
#pragma once
#include "part.hpp"

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

}  // namespace plastron::cad
