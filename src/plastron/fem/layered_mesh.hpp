// Coarse meshes with rows of long thin cells along the boundaries, where edge layers of thin shells are.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <array>
#include <vector>

namespace plastron::fem {

struct Rows {
  /// Of each boundary, as boundary_names() orders them, and of each region along it (those of a rectangle from left to right, otherwise one): how
  /// far the lines between rows are from the boundary, ascending, in Omega. All regions along a boundary have as many; none: no rows.
  std::vector<std::vector<std::vector<double>>> distances;
  /// Cells between the rows: along x and y of a rectangle or a polygon of four corners; of a disk round each quarter (and across the square in the
  /// middle) and from the square outwards; of an annulus around (0: as square as can be) and outwards; of other polygons, those along half the
  /// perimeter.
  std::array<int, 2> inner{1, 1};
  /// Of a disk: the radius beyond which all cells lie in rings; 0: they begin with the rows. `inner` counts the cells outwards within it, then.
  double core = 0;
  int rings = 1;  ///< between that radius and the rows
};

/// Throws DomainError where the rows leave nothing between them, and for mesh files. Triangles are the quadrilaterals cut crosswise.
CoarseMesh layered_mesh(const Domain& domain, Shape shape, const Rows& rows);

/// The polygon part of layered_mesh.
CoarseMesh layered_polygon(const Polygon& polygon, const Rows& rows);

}  // namespace plastron::fem
