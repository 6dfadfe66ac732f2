// A mesh of cells in space, as a file describes it. Two cells are neighbours if they name the same nodes.
#pragma once
#include <plastron/mesh/coarse_mesh.hpp>

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plastron::topology {

using Eigen::Vector3d;

/// An error of a surface mesh. The text does not name its file.
struct SurfaceError : mesh::DomainError {
  enum class About {
    surface,  ///< all meshes of the surface have it
    cells,    ///< other cells of the surface may not have it
    border    ///< parts of the surface are not joined
  };
  SurfaceError(About what, const std::string& text) : DomainError(text), about(what) {}
  About about;
};

struct SurfaceCell {
  std::vector<std::int32_t> nodes;  ///< on lattice(shape, order), xi_1 fastest
  int order = 1;
  int region = 0;
  std::int64_t tag = 0;
  std::size_t line = 0;  ///< line of the file; 0: not from a file
  /// Normals of the surface from which the mesh was made, at the nodes; empty if they are not known. Of any length.
  std::vector<Vector3d> normals{};
};

struct SpaceMesh {
  mesh::Shape shape = mesh::Shape::quadrilateral;  ///< of all cells
  std::vector<Vector3d> nodes;
  std::vector<SurfaceCell> cells;
  std::vector<std::optional<Vector3d>> normals{};  ///< normals that the file gives at nodes; empty if it gives none
};

/// Returns "element 7 (line 31)".
std::string place_of(const SurfaceCell& cell);
/// Returns "(1, 0.5, -2)".
std::string place_of(const Vector3d& point);

/// Returns the nodes at the cell's corners, in the order of CoarseCell::vertices. A triangle's fourth is -1.
std::array<int, 4> corner_nodes(mesh::Shape shape, const SurfaceCell& cell);
/// Returns the cell with its coordinates xi_1 and xi_2 swapped. Its normal a_1 x a_2 changes sign.
SurfaceCell turned(mesh::Shape shape, const SurfaceCell& cell);

/// Returns the sides of all cells in ascending order of their ends, which are nodes.
std::vector<mesh::MeshEdge> edges_of(const SpaceMesh& mesh);
/// Positions on the cell's lattice of the nodes of a side, from its lower end to its higher one.
std::vector<int> ascending_places(const SpaceMesh& mesh, const mesh::MeshEdge& side);

/// Diagonal of the bounding box of the cells' nodes [m].
double diagonal(const SpaceMesh& mesh);

struct MergedMesh {
  SpaceMesh mesh;
  std::vector<std::int32_t> new_number;  ///< of each node of the mesh before
  std::size_t merged = 0;                ///< number of nodes that became equal to another one
};
/// Makes one node of two that are not farther apart than the tolerance [m], if one of them lies on a side that is not
/// joined. Throws SurfaceError if two nodes of one cell become equal.
MergedMesh merge_nodes(SpaceMesh mesh, double tolerance);
/// Default tolerance of merge_nodes(): 1e-9 of the diagonal [m].
double merge_tolerance(const SpaceMesh& mesh);

}  // namespace plastron::topology
