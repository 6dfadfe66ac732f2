// The patterns that coarse meshes of the built-in domains are made of: grids, disks and rings.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <span>
#include <vector>

namespace plastron::fem {

/// Cells with straight sides between vertices that are listed row by row; of region 0, edges on boundaries 0 to 3: first column, last
/// column, first row, last row.
CoarseMesh grid_mesh(std::vector<Vector2d> vertices, std::size_t columns);

/// A square in the middle, cell 0, and four cells that run from its sides to the rim, whose vertices are 4 to 7.
CoarseMesh disk_mesh(const Disk& disk);

/// Sectors of equal angles around a point.
struct Rings {
  Vector2d centre;
  double first_angle;  ///< where the first sector begins [rad]
  int sectors;
  double angle(int k) const;
  Vector2d at(double radius, int k) const;
};

/// Adds a ring of cells between each radius and the next, xi_1 outwards, xi_2 anticlockwise. The vertices on the first radius are there.
void add_rings(const Rings& rings, std::span<const double> radii, std::vector<int> first, CoarseMesh& mesh);
/// The annulus between the first radius and the last.
CoarseMesh ring_mesh(const Rings& rings, std::span<const double> radii);
/// As many as make cells from rim to rim about square, 6 to 32.
int annulus_sectors(const Annulus& annulus);

}  // namespace plastron::fem
