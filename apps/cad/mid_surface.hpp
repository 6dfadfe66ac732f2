// Moves a mesh of one side of each sheet to the middle between the sides.
#pragma once
#include "sampling.hpp"

namespace plastron::cad {

/// Moves the nodes on sides of sheets (sheets.hpp) to the middle, against the normals of the faces; where faces meet at an angle, to the
/// place that has its distance from all of them. Throws PartError if this leaves the solids.
void move_to_middle(const PartFile& part, const JoinedPart& joined, SampledMesh& mesh);

}  // namespace plastron::cad
