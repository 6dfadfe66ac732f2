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

/// An edge of a named curve, on the boundary or inside; an edge of several curves stands once for each.
struct BoundaryEdge {
  std::array<int, 2> vertices;
  int boundary = 0;  ///< index into CoarseMesh::boundaries
};

/// Where a quadrilateral is cut, across xi_1 and across xi_2: numbers between 0 and 1, ascending.
using Cuts = std::array<std::vector<double>, 2>;

struct CoarseMesh {
  Shape shape = Shape::quadrilateral;
  std::vector<Vector2d> vertices;
  std::vector<CoarseCell> cells;
  std::vector<BoundaryEdge> edges;
  std::vector<std::string> regions;
  std::vector<std::string> boundaries;
  /// Of the cells of a coarser mesh, if this one was made of it by a mesh sequence that cut them (fem/cut_mesh.hpp); else none.
  std::vector<Cuts> cuts{};
};

/// Throws DomainError where the domain cannot be meshed or a mesh file is not as it should be. Triangles of a built-in
/// domain are its quadrilaterals cut crosswise, polygons apart.
CoarseMesh coarse_mesh(const Domain& domain, Shape shape);

/// The .msh part of coarse_mesh, from the file whether or not it was read before. Among triangles, quadrilaterals of the file are cut crosswise.
CoarseMesh read_mesh_file(const MeshFile& file, Shape shape);
/// The polygon part of coarse_mesh: by Gmsh unless the polygon is a convex quadrilateral itself.
CoarseMesh mesh_polygon(const Polygon& polygon, Shape shape);

/// A mesh of quadrilaterals, each cut in four.
CoarseMesh cut_crosswise(CoarseMesh quadrilaterals);
/// Adds the four triangles from the centre of a quadrilateral to its sides: no triangle has all its vertices on the
/// boundary, not even at a corner. Quadrilaterals with straight sides give straight triangles, which have constant
/// strains in their space; others keep their exact map. `mesh` has the quadrilateral's vertices.
void cut_crosswise(const CoarseCell& quadrilateral, CoarseMesh& mesh);

}  // namespace plastron::fem
