// The coarsest mesh of a domain: a few quadrilaterals or triangles with exact maps, named regions and boundaries.
#pragma once
#include <plastron/fem/cell_map.hpp>
#include <plastron/fem/domain.hpp>
#include <plastron/fem/reference_cell.hpp>

#include <array>
#include <string>
#include <vector>

namespace plastron::fem {

/// Vertices in the order (0,0), (1,0), (0,1), (1,1) of the cell's own coordinates; a triangle's fourth is -1.
struct CoarseCell {
  std::array<int, 4> vertices;
  int region = 0;  ///< index into CoarseMesh::regions
  CellMap map;
};

/// An edge of a named curve, on the boundary or inside. An edge of several curves occurs once for each.
struct BoundaryEdge {
  std::array<int, 2> vertices;
  int boundary = 0;  ///< index into CoarseMesh::boundaries
};

/// Positions where a quadrilateral is cut, across xi_1 and across xi_2: numbers between 0 and 1, ascending.
using Cuts = std::array<std::vector<double>, 2>;

struct CoarseMesh {
  Shape shape = Shape::quadrilateral;
  std::vector<Vector2d> vertices;
  std::vector<CoarseCell> cells;
  std::vector<BoundaryEdge> edges;
  std::vector<std::string> regions;
  std::vector<std::string> boundaries;
  /// Cuts of a coarser mesh's cells, if a mesh sequence made this mesh by cutting them (fem/cut_mesh.hpp); else
  /// empty.
  std::vector<Cuts> cuts{};
};

/// Makes the coarse mesh. Throws DomainError if the domain cannot be meshed or a mesh file is invalid. Triangles of a
/// built-in domain are its quadrilaterals cut crosswise, except for polygons.
CoarseMesh coarse_mesh(const Domain& domain, Shape shape);

/// Makes the coarse mesh of a .msh file and always reads the file. For triangles, quadrilaterals of the file are cut
/// crosswise.
CoarseMesh read_mesh_file(const MeshFile& file, Shape shape);
/// Makes the coarse mesh of a polygon by Gmsh, or directly if the polygon is a convex quadrilateral.
CoarseMesh mesh_polygon(const Polygon& polygon, Shape shape);

/// Cuts each quadrilateral of a mesh in four triangles.
CoarseMesh cut_crosswise(CoarseMesh quadrilaterals);
/// Adds the four triangles from the centre of a quadrilateral to its sides: no triangle has all its vertices on the
/// boundary, not even at a corner. Quadrilaterals with straight sides give straight triangles, whose space contains
/// constant strains; others keep their exact map. `mesh` contains the quadrilateral's vertices.
void cut_crosswise(const CoarseCell& quadrilateral, CoarseMesh& mesh);

}  // namespace plastron::fem
