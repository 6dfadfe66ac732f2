// Checks that cells of a mesh file form a mesh of a plane domain. Every side must belong to one cell or join two, no
// vertex may lie inside a side, and no two cells may overlap.
#pragma once
#include <plastron/fem/coarse_mesh.hpp>
#include <plastron/fem/mesh_data.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plastron::fem {

/// Triangles (their fourth vertex is -1) and quadrilaterals, all anticlockwise, each with its element of the file.
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
  bool is_forward;  ///< true if it runs from the lower vertex to the higher one, anticlockwise round the cell
};
/// Returns the sides of all cells, in ascending order of their ends.
std::vector<MeshEdge> edges_of(const std::vector<CoarseCell>& cells);

/// Checks the cells. Throws DomainError that names the elements and the place. `source` is the start of the message.
void check_cells_fit(const FileCells& cells, const std::vector<MeshEdge>& edges, const std::string& source);

/// A vertex in the interior of a side.
struct HangingVertex {
  int vertex;
  MeshEdge edge;
};
/// Searches for such a vertex. Precondition: `boundary` contains the edges that belong to only one cell.
std::optional<HangingVertex> find_hanging_vertex(const CoarseMesh& mesh, const std::vector<MeshEdge>& boundary);

/// Returns two cells of which one contains the other's centre.
std::optional<std::array<std::size_t, 2>> find_overlap(const CoarseMesh& mesh);

}  // namespace plastron::fem
