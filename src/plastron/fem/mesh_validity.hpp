// Whether cells of a mesh file make a mesh of a plane domain: every side belongs to one cell or joins two, no vertex
// lies inside of a side, no two cells overlap.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/fem/mesh_data.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plastron::fem {

/// Triangles (their fourth vertex is -1) and quadrilaterals, all anticlockwise, each with the element it comes from.
struct FileCells {
  CoarseMesh mesh;
  std::vector<const MeshElement*> elements;
};

inline Shape shape_of(const CoarseCell& cell) { return cell.vertices[3] < 0 ? Shape::triangle : Shape::quadrilateral; }

/// A side of a cell between two vertices.
struct MeshEdge {
  std::array<int, 2> ends;  ///< ascending
  std::size_t cell;
  int side;
  bool is_forward;  ///< round the cell, anticlockwise, it runs from the lower vertex to the higher
};
/// Of all cells, ascending by ends.
std::vector<MeshEdge> edges_of(const std::vector<CoarseCell>& cells);

/// Throws DomainError that names the elements and the place. `source` begins the message.
void check_cells_fit(const FileCells& cells, const std::vector<MeshEdge>& edges, const std::string& source);

/// A vertex in the interior of a side that it is no end of.
struct HangingVertex {
  int vertex;
  MeshEdge edge;
};
/// Precondition: `boundary` are the edges that belong to one cell alone.
std::optional<HangingVertex> find_hanging_vertex(const CoarseMesh& mesh, const std::vector<MeshEdge>& boundary);

/// Two cells of which one holds the other's centre.
std::optional<std::array<std::size_t, 2>> find_overlap(const CoarseMesh& mesh);

}  // namespace plastron::fem
