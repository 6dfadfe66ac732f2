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

/// A place where smaller cells are needed.
struct SmallPlace {
  Vector3d centre;
  double size;  ///< sides of cells there [mm]
};

/// Meshes the faces with quadrilaterals whose sides are about `size` long [mm], shorter at some places. Throws PartError
/// with Gmsh's reason.
Quads quads_of(const JoinedPart& part, double size, const std::vector<SmallPlace>& small = {});

}  // namespace plastron::cad
