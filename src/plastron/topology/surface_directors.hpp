// Normals of the cells at their nodes, and their means, the directors.
#pragma once
#include <plastron/topology/space_mesh.hpp>

#include <vector>

namespace plastron::topology {

/// Unit normals of the cells at the nodes of their lattices, cell by cell.
struct LatticeNormals {
  std::vector<std::size_t> first;  ///< of each cell: index of its first node's normal
  std::vector<Vector3d> normal;
  std::vector<double> weight;  ///< angle of the cell at a corner [rad]; 1 at other nodes

  const Vector3d& at(std::size_t cell, int place) const { return normal[first[cell] + place]; }
};
/// Throws SurfaceError for a cell that is degenerate at a node.
LatticeNormals lattice_normals(const SpaceMesh& mesh);

/// The angle between two vectors [rad].
double angle_between(const Vector3d& a, const Vector3d& b);

/// A copy of a node for one fan.
struct DirectorNode {
  std::int32_t node;
  Vector3d director;  ///< unit vector
};

struct DirectorAngle {
  double angle = 0;  ///< between a director and the normal of a cell there [rad]
  std::size_t cell = 0;
  Vector3d where = Vector3d::Zero();
};

/// Computes the directors of the copies, which are in ascending order of their nodes. A director is the weighted mean of
/// the normals of the fan's cells, corrected at the surface's end (below). If the file gives a normal for the node, that
/// normal, in the direction of the mean, is the director of each fan whose mean is within 60 degrees of it.
/// `cell_director_nodes` are the copies of each cell on its lattice. `ends`: whether the smooth surface ends at a side,
/// by cell and side. Returns the largest angle between a director and the normal of a cell. Throws SurfaceError if this
/// angle exceeds 80 degrees, and if a normal of the file is more than 60 degrees off all fans of its node.
///
/// On a surface of constant curvature, and for odd orders on every surface, the errors of the normals at both ends of a cell are
/// opposite, so that they cancel in the mean of two cells. At an end of the surface there is no second cell. There a cell's normal is corrected by its error at the
/// opposite node, which the mean there shows, turned with the normal: n - (d - n)_opposite. For facets this is the mirror image of the opposite
/// director; the directors of a cylinder then are radial at its edges, too.
DirectorAngle set_directors(const SpaceMesh& mesh, const LatticeNormals& normals,
                            const std::vector<std::vector<std::int32_t>>& cell_director_nodes,
                            const std::vector<bool>& ends, std::vector<DirectorNode>& director_nodes);

}  // namespace plastron::topology
