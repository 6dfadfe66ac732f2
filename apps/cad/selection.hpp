// The names of faces and edges: those of the file, those of the program ("face 3", "edge 7"), and those that the case
// gives to a selection.
#pragma once
#include "part.hpp"

#include <string>
#include <vector>

namespace plastron::cad {

/// Keeps the faces that the job chooses. Throws PartError if none is left.
std::vector<LabelledFace> chosen_faces(const PartFile& part, const Job& job);

struct PartNames {
  std::vector<std::string> regions;                  ///< of each face
  std::vector<std::vector<std::string>> boundaries;  ///< of each edge: "edge N", then names of the case
};

/// Throws PartError for a selection that finds nothing and for a face in two regions.
PartNames names_of(const JoinedPart& part, const Job& job);

}  // namespace plastron::cad
