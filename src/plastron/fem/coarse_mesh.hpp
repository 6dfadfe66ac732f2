// The coarsest mesh of a domain: a few quadrilaterals with exact maps, named regions and named boundaries.
#pragma once
#include <plastron/fem/cell_map.hpp>
#include <plastron/fem/domain.hpp>

#include <array>
#include <string>
#include <vector>

namespace plastron::fem {

/// Vertices in the order (0,0), (1,0), (0,1), (1,1) of the cell's own coordinates.
struct CoarseCell {
  std::array<int, 4> vertices;
  int region = 0;  ///< index into CoarseMesh::regions
  CellMap map;
};

struct BoundaryEdge {
  std::array<int, 2> vertices;
  int boundary = 0;  ///< index into CoarseMesh::boundaries
};

struct CoarseMesh {
  std::vector<Vector2d> vertices;
  std::vector<CoarseCell> cells;
  std::vector<BoundaryEdge> edges;
  std::vector<std::string> regions;
  std::vector<std::string> boundaries;
};

/// Throws DomainError where the domain cannot be meshed or a mesh file is not as it should be.
CoarseMesh coarse_mesh(const Domain& domain);

/// The .msh part of coarse_mesh (Gmsh).
CoarseMesh read_mesh_file(const MeshFile& file);
/// The polygon part of coarse_mesh: quadrilaterals by Gmsh unless the polygon is a convex quadrilateral itself.
CoarseMesh mesh_polygon(const Polygon& polygon);

}  // namespace plastron::fem
