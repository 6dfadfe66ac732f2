// Checks that cells of a mesh file form a mesh of a plane domain. The map of each cell must be one to one. Every side
// must belong to one cell or join two, no vertex may lie inside a side, and no two cells may overlap.
#pragma once
#include <plastron/domain/mesh_data.hpp>
#include <plastron/mesh/basis.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plastron::domain {

using Eigen::Vector2d;

// A test whether the polynomial map of a cell is one to one: the sign of its determinant at many points.

/// Returns the polynomials of a map at points dense enough to detect a change of sign of its determinant.
mesh::LatticeTable jacobian_table(mesh::Shape shape, int order);

struct JacobianRange {
  bool is_positive = true, is_negative = true;  ///< at all points
  Vector2d worst = Vector2d::Zero();  ///< image of the point where the cell is most nearly degenerate, or folded
};
/// Evaluates the determinant of the map through `nodes`, which are in the order of the lattice.
JacobianRange jacobian_range(const mesh::LatticeTable& table, const std::vector<Vector2d>& nodes);

/// Triangles (their fourth vertex is -1) and quadrilaterals, all anticlockwise, each with its element of the file.
struct FileCells {
  mesh::CoarseMesh mesh;
  std::vector<const MeshElement*> elements;
};

/// Checks the cells. Throws DomainError that names the elements and the place. `source` is the start of the message.
void check_cells_fit(const FileCells& cells, const std::vector<mesh::MeshEdge>& edges, const std::string& source);

}  // namespace plastron::domain
