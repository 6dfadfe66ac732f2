// Quadrilaterals from triangles: pairs of triangles become quadrilaterals, and every cell is divided at the middles of
// its sides.
#pragma once
#include <plastron/facets/remesh.hpp>

#include <optional>

namespace plastron::facets {

struct Cells {
  std::vector<Vector3d> points{};                    ///< on the facets [m]
  std::vector<std::array<int, 4>> quadrilaterals{};  ///< corners, anticlockwise seen from the side of a_3
  std::vector<int> face_of{};                        ///< of each quadrilateral, index into Facets::faces
  std::vector<Remeshed::Line> lines{};
};

/// Makes quadrilaterals with sides of about `size` [m]: triangles (remesh; without `size` the facets), of which pairs are divided
/// in four and the others in three. The middles of sides and cells are put onto the facets, those of lines onto their curves. A pair is
/// taken if all its angles are between 30 and 150 degrees, the best pairs first. Throws FileError as remesh().
Cells quadrilaterals(const Facets& facets, std::optional<double> size, const std::string& name);

}  // namespace plastron::facets
