// Quadrilaterals on the faces of a part, by Gmsh.
#pragma once
#include "part.hpp"

#include <array>
#include <vector>

namespace plastron::cad {

struct Quads {
  struct Cell {
    std::array<int, 4> corners;  ///< anticlockwise or clockwise
    int face;                    ///< number in JoinedPart::faces
  };
  struct Line {
    std::array<int, 2> ends;
    int edge;  ///< number in JoinedPart::edges
  };
  std::vector<Vector3d> points;  ///< [mm]
  std::vector<Cell> cells;
  std::vector<Line> lines;
};

/// Meshes the faces with quadrilaterals whose sides are about `size` long [mm], smaller where the faces are curved: at least
/// `round_a_circle` of them would go round a circle of their radius; 0: eight on round edges. Throws PartError with Gmsh's reason.
Quads quads_of(const JoinedPart& part, double size, int round_a_circle);

}  // namespace plastron::cad
