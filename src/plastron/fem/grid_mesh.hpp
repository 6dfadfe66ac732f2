// Patterns for coarse meshes of the built-in domains: grids, disks and rings.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>

#include <span>
#include <vector>

namespace plastron::fem {

/// Returns cells with straight sides between vertices listed row by row. All have region 0. Edges are on boundaries 0
/// to 3: first column, last column, first row, last row.
CoarseMesh grid_mesh(std::vector<Vector2d> vertices, std::size_t columns);

/// Returns a square in the middle, cell 0, and four cells from its sides to the rim, whose vertices are 4 to 7.
CoarseMesh disk_mesh(const Disk& disk);

/// Sectors of equal angles around a point.
struct Rings {
  Vector2d centre;
  double first_angle;  ///< angle at the start of the first sector [rad]
  int sectors;
  double angle(int k) const;
  Vector2d at(double radius, int k) const;
};

/// Adds a ring of cells between each radius and the next, xi_1 outwards, xi_2 anticlockwise. `first` are the existing
/// vertices on the first radius.
void add_rings(const Rings& rings, std::span<const double> radii, std::vector<int> first, CoarseMesh& mesh);
/// Returns the annulus between the first radius and the last.
CoarseMesh ring_mesh(const Rings& rings, std::span<const double> radii);
/// Number of sectors, 6 to 32, for which cells from rim to rim are nearly square.
int annulus_sectors(const Annulus& annulus);

}  // namespace plastron::fem
