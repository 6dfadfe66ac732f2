// Meshes in space from files: the cells are the mid-surface. What the file says is kept as the topology of its cells with
// names, from which the coarse mesh and the reports are made.
#pragma once
#include <plastron/domain/domain.hpp>
#include <plastron/topology/surface_topology.hpp>

#include <map>
#include <string>
#include <vector>

namespace plastron::domain {

/// A named curve's piece on an edge of the topology.
struct NamedEdge {
  std::size_t edge = 0;      ///< index of SurfaceTopology::edges
  int boundary = 0;          ///< index of FileSurface::boundaries
  bool is_ascending = true;  ///< drawn from the lower node to the higher one
};

struct FileSurface {
  topology::SurfaceTopology topology{};
  std::vector<std::string> regions{}, boundaries{};
  std::vector<NamedEdge> named_edges{};
  std::size_t merged_nodes = 0;         ///< nodes that the file had twice at one place
  std::vector<std::string> notes{};     ///< contents of the file that are not read
  std::vector<std::string> warnings{};  ///< flaws that can be computed with
  bool is_remeshed = false;             ///< whether the cells were made from the facets of the file
  bool has_upper = false;               ///< whether the case names the side of a_3
  double symmetry_turn = 0;             ///< largest angle by which a director was put into a plane of symmetry [rad]
  /// How well the mesh knows directions on boundaries in planes of symmetry: the largest angle between a director and the normals
  /// of the cells there, within limits [rad]
  std::map<std::string, double> symmetry_accuracy{};
};

/// Reads the file and finds the topology. Throws DomainError for files that cannot be read and for cells that are no
/// surface. Without a shape the file's cells may have either one. Precondition: file.in_space.
FileSurface read_surface(const MeshFile& file, std::optional<mesh::Shape> shape);

/// Puts the directors on a boundary into its plane, for an edge of symmetry: a mean over the cells of one side is off the
/// plane by the mesh's error. Nothing changes if there is no such boundary, if it leaves its plane by more than `symmetry_accuracy`, or where
/// the shell meets the plane obliquely.
void put_into_plane(const std::string& boundary, FileSurface& surface);

/// Makes the coarse mesh: cells with patches, named regions and boundaries, and the folds, each connected set of which
/// is also a boundary "fold 1", "fold 2", ... For triangles, quadrilaterals are cut crosswise.
mesh::CoarseMesh surface_mesh(const FileSurface& surface, mesh::Shape shape);

}  // namespace plastron::domain
