// Plane faces that end on other sheets, extended to the middle of those.
#pragma once
#include "part.hpp"

#include <gp_Pln.hxx>

#include <vector>

namespace plastron::cad {

/// An edge at which a rib ends.
struct RibEnd {
  TopoDS_Edge edge;                  ///< with its orientation in the face
  std::vector<TopoDS_Face> borders;  ///< how far the rib shall reach
  double thickness = 0;              ///< of the sheet that it meets [mm]
};

/// An edge at which a rib is bent without a fillet.
struct RibBend {
  TopoDS_Edge edge;     ///< with its orientation in the face
  gp_Pln other_middle;  ///< of the face beyond it
};

struct Rib {
  TopoDS_Face face;  ///< one side of it, a plane
  gp_Pln middle;
  Vector3d outward;  ///< normal of the face out of the solid
  int number = 0;    ///< of the face, for messages
  std::vector<RibEnd> ends{};
  std::vector<RibBend> bends{};
};

/// Returns the face in the middle of a rib, with strips beyond its ends up to the borders, and with the corners between strips. At
/// bends the face ends where the middles meet.
/// `size`: of the part [mm]. Throws PartError where the borders are not met.
TopoDS_Face extended(const Rib& rib, double thickness, double size);

}  // namespace plastron::cad
