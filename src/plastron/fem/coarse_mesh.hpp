// The coarsest mesh of a domain: a few quadrilaterals or triangles with exact maps, named regions and boundaries; and the
// patterns of which the meshes of built-in domains are made: grids, disks and rings.
#pragma once
#include <plastron/fem/cell_map.hpp>
#include <plastron/fem/domain.hpp>

#include <mpi.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plastron::fem {

/// Vertices in the order (0,0), (1,0), (0,1), (1,1) of the cell's own coordinates; a triangle's fourth is -1.
struct CoarseCell {
  std::array<int, 4> vertices;
  int region = 0;  ///< index into CoarseMesh::regions
  CellMap map;     ///< onto a part of Omega or, on a mesh in space, of the patch's reference cell
  int patch = -1;  ///< index into CoarseMesh::patches; -1: the cell lies in Omega
};

/// An edge of a named curve, on the boundary or inside. An edge of several curves occurs once for each.
struct BoundaryEdge {
  std::array<int, 2> vertices;
  int boundary = 0;  ///< index into CoarseMesh::boundaries
};

/// Positions where a quadrilateral is cut, across xi_1 and across xi_2: numbers between 0 and 1, ascending.
using Cuts = std::array<std::vector<double>, 2>;

/// A fold or branch: two edges of cells that lie on each other in space and belong to different sides of the angle.
struct Fold {
  std::array<std::array<int, 2>, 2> edges;  ///< vertices of both edges, ascending
};

struct SurfacePatches;

struct CoarseMesh {
  Shape shape = Shape::quadrilateral;
  std::vector<Vector2d> vertices;  ///< on a mesh in space only names: their coordinates have no meaning
  std::vector<CoarseCell> cells;
  std::vector<BoundaryEdge> edges;
  std::vector<std::string> regions;
  std::vector<std::string> boundaries;
  /// Cuts of a coarser mesh's cells, if a mesh sequence made this mesh by cutting them (fem/cut_mesh.hpp); else
  /// empty.
  std::vector<Cuts> cuts{};
  std::shared_ptr<const SurfacePatches> patches{};  ///< the surface of a mesh in space; null in a plane domain
  std::vector<Fold> folds{};                        ///< pairs of edges joined at an angle; only on meshes in space
  std::vector<std::string> fold_boundaries{};       ///< names of boundaries that consist of connected folds
};

/// The address of a point of a mesh in space takes the place of a point of Omega: (2 c + xi_1, xi_2) for the point xi of
/// patch c. Omega is then a row of reference cells, one for each patch.
inline Vector2d address_of(int patch, const Vector2d& xi) { return {2.0 * patch + xi[0], xi[1]}; }
inline int patch_of(const Vector2d& address) { return static_cast<int>(std::floor(address[0] / 2)); }

/// Makes the coarse mesh. Throws DomainError if the domain cannot be meshed or a mesh file is invalid. Triangles of a
/// built-in domain are its quadrilaterals cut crosswise, except for polygons.
CoarseMesh coarse_mesh(const Domain& domain, Shape shape);

/// Makes the coarse mesh of a .msh file and always reads the file. For triangles, quadrilaterals of the file are cut
/// crosswise.
CoarseMesh read_mesh_file(const MeshFile& file, Shape shape);
/// Returns the domain. A mesh file gets the coarse mesh of the given shape, read and checked by the first rank and sent
/// to the others, so that coarse_mesh() need not read the file (collective). It gets none if the file is invalid;
/// coarse_mesh() then reports the error. It also gets none if some ranks have another kind of domain.
Domain with_shared_mesh(Domain domain, Shape shape, MPI_Comm comm);

/// Makes the coarse mesh of a polygon by Gmsh, or directly if the polygon is a convex quadrilateral.
CoarseMesh mesh_polygon(const Polygon& polygon, Shape shape);
/// Makes the mesh by Gmsh with cells of about `length`. Quadrilaterals have half this size because they are divided
/// triangles.
CoarseMesh gmsh_polygon(const Polygon& polygon, Shape shape, double length);

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

/// Cuts each quadrilateral of a mesh in four triangles.
CoarseMesh cut_crosswise(CoarseMesh quadrilaterals);
/// Adds the four triangles from the centre of a quadrilateral to its sides: no triangle has all its vertices on the
/// boundary, not even at a corner. Quadrilaterals with straight sides give straight triangles, whose space contains
/// constant strains; others keep their exact map. `mesh` contains the quadrilateral's vertices.
void cut_crosswise(const CoarseCell& quadrilateral, CoarseMesh& mesh);

inline Shape shape_of(const CoarseCell& cell) { return cell.vertices[3] < 0 ? Shape::triangle : Shape::quadrilateral; }

/// A side of a cell between two vertices.
struct MeshEdge {
  std::array<int, 2> ends;  ///< ascending
  std::size_t cell;
  int side;
  bool is_forward;  ///< true if it runs from the lower vertex to the higher one, anticlockwise round the cell
};
/// Returns the sides of all cells, in ascending order of their ends.
std::vector<MeshEdge> edges_of(const std::vector<CoarseCell>& cells);

/// Returns two cells of which one contains the other's centre. They overlap without sharing a side.
std::optional<std::array<std::size_t, 2>> find_overlap(const CoarseMesh& mesh);

/// Nodes that all finer meshes contain too: corners of the cells; for even degree also the middles of their sides and
/// of quadrilaterals. Other nodes change place when a cell is divided. Some nodes are listed more than once.
std::vector<Vector2d> kept_nodes(const CoarseMesh& coarse, int degree);

/// Points of Omega within this distance are identical: 1e-9 of the longest side of the vertices' bounding box.
double point_tolerance(const CoarseMesh& coarse);

}  // namespace plastron::fem
