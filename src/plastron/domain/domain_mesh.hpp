// Coarse meshes of domains: of files, polygons and built-in domains; and the patterns of which those of built-in
// domains are made: grids, disks and rings.
#pragma once
#include <plastron/domain/domain.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <mpi.h>

#include <span>
#include <vector>

namespace plastron::domain {

/// Makes the coarse mesh. Throws DomainError if the domain cannot be meshed or a mesh file is invalid. Triangles of a
/// built-in domain are its quadrilaterals cut crosswise, except for polygons.
mesh::CoarseMesh coarse_mesh(const Domain& domain, mesh::Shape shape);

/// Makes the coarse mesh of a .msh file and always reads the file. For triangles, quadrilaterals of the file are cut
/// crosswise.
mesh::CoarseMesh read_mesh_file(const MeshFile& file, mesh::Shape shape);
/// Returns the domain. A mesh file gets the coarse mesh of the given shape, read and checked by the first rank and sent
/// to the others, so that coarse_mesh() need not read the file (collective). It gets none if the file is invalid;
/// coarse_mesh() then reports the error. It also gets none if some ranks have another kind of domain.
Domain with_shared_mesh(Domain domain, mesh::Shape shape, MPI_Comm comm);

/// Makes the coarse mesh of a polygon by Gmsh, or directly if the polygon is a convex quadrilateral.
mesh::CoarseMesh mesh_polygon(const Polygon& polygon, mesh::Shape shape);
/// Makes the mesh by Gmsh with cells of about `length`. Quadrilaterals have half this size because they are divided
/// triangles.
mesh::CoarseMesh gmsh_polygon(const Polygon& polygon, mesh::Shape shape, double length);

/// Returns cells with straight sides between vertices listed row by row. All have region 0. Edges are on boundaries 0
/// to 3: first column, last column, first row, last row.
mesh::CoarseMesh grid_mesh(std::vector<Vector2d> vertices, std::size_t columns);

/// Returns a square in the middle, cell 0, and four cells from its sides to the rim, whose vertices are 4 to 7.
mesh::CoarseMesh disk_mesh(const Disk& disk);

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
void add_rings(const Rings& rings, std::span<const double> radii, std::vector<int> first, mesh::CoarseMesh& mesh);
/// Returns the annulus between the first radius and the last.
mesh::CoarseMesh ring_mesh(const Rings& rings, std::span<const double> radii);
/// Number of sectors, 6 to 32, for which cells from rim to rim are nearly square.
int annulus_sectors(const Annulus& annulus);

}  // namespace plastron::domain
