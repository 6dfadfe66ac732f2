// Coarse meshes with rows of long thin cells along the boundaries, for the edge layers of thin shells.
#pragma once
#include <plastron/domain/domain.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <array>
#include <vector>

namespace plastron::meshing {

struct Rows {
  /// Distances in Omega of the lines between rows from the boundary, ascending. One list for each boundary in the
  /// order of boundary_names() and for each region along it (regions of a rectangle from left to right, otherwise
  /// one). All regions along a boundary have the same number of lines; without lines there are no rows.
  std::vector<std::vector<std::vector<double>>> distances;
  /// Cells between the rows. Rectangle or polygon of four corners: along x and y. Disk: round each quarter (and
  /// across the square in the middle), and from the square outwards. Annulus: around (0: nearly square), and
  /// outwards. Other polygons: along half the perimeter.
  std::array<int, 2> inner{1, 1};
  /// Disk only: the radius beyond which all cells lie in rings, or 0 if rings begin with the rows. If it is set,
  /// `inner` counts the cells outwards within it.
  double core = 0;
  int rings = 1;  ///< number of rings between `core` and the rows
};

/// Makes the mesh. Throws DomainError if the rows leave no space between them, and for mesh files. Triangles are the
/// quadrilaterals cut crosswise.
mesh::CoarseMesh layered_mesh(const domain::Domain& domain, mesh::Shape shape, const Rows& rows);

/// Makes the layered mesh of a polygon.
mesh::CoarseMesh layered_polygon(const domain::Polygon& polygon, const Rows& rows);

}  // namespace plastron::meshing
