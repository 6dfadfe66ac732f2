// The coarsest mesh of a domain: a few quadrilaterals or triangles with exact maps, named regions and boundaries.
#pragma once
#include <plastron/mesh/cell_map.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plastron::mesh {

/// Error in a domain or mesh file; its text is shown to the user unchanged.
struct DomainError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

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
class SurfaceShift;

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
  std::vector<std::shared_ptr<const SurfaceShift>> shifts{};  ///< changes of the mid-surface; they add up
  std::vector<Fold> folds{};                   ///< pairs of edges joined at an angle; only on meshes in space
  std::vector<std::string> fold_boundaries{};  ///< names of boundaries that consist of connected folds
};

/// The address of a point of a mesh in space takes the place of a point of Omega: (2 c + xi_1, xi_2) for the point xi of
/// patch c. Omega is then a row of reference cells, one for each patch.
inline Vector2d address_of(int patch, const Vector2d& xi) { return {2.0 * patch + xi[0], xi[1]}; }
inline int patch_of(const Vector2d& address) { return static_cast<int>(std::floor(address[0] / 2)); }

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

}  // namespace plastron::mesh
