// Topology of a mesh in space: neighbours, orientation, kinds of edges, sheets, and the copies of nodes along edges
// where the surface is cut. With them come the directors, the mean normals at nodes.
//
// At a smooth edge two cells share their nodes and directors. Folds (two cells) and branches (three or more) are cut:
// every cell there has its own copies of the nodes. A fan is a set of cells at a node that are connected through smooth
// edges at this node; there is one copy for each fan. So the cells with the vertices `cell_vertices` are a manifold
// with a border and at most two cells at an edge, whose neighbours have opposite directions along their common edge.
#pragma once
#include <plastron/topology/surface_directors.hpp>
#include <plastron/topology/surface_orientation.hpp>

#include <array>
#include <optional>
#include <set>
#include <vector>

namespace plastron::topology {

struct SurfaceOptions {
  /// Largest angle of a smooth edge [rad]; default 30 degrees if there are cells of order 1, otherwise 10 degrees.
  std::optional<double> smooth_angle{};
  std::optional<Vector3d> upper{};       ///< direction of a_3, on average over each component
  std::set<std::array<int, 2>> folds{};  ///< ends (ascending nodes) of edges that are folds at any angle
};

struct SurfaceTopology {
  SpaceMesh mesh;                     ///< with turned cells; everything else refers to it
  std::vector<bool> is_turned;        ///< for each cell
  std::vector<mesh::MeshEdge> sides;  ///< of all cells, in the order of `edges`
  std::vector<SurfaceEdge> edges;     ///< in ascending order of their ends
  std::vector<int> component;         ///< of each cell: index of `components`
  std::vector<SurfaceComponent> components;
  std::vector<int> sheet;   ///< of each cell; cells of a sheet are connected through smooth edges
  double smooth_angle = 0;  ///< largest angle of an edge that counts as smooth [rad]
  int sheet_count = 0;
  int part_count = 0;                                          ///< parts are connected through edges of any kind
  std::vector<DirectorNode> director_nodes;                    ///< in ascending order of nodes
  std::vector<std::vector<std::int32_t>> cell_director_nodes;  ///< for each cell, on its lattice
  std::vector<std::array<int, 4>> cell_vertices;               ///< in the order of CoarseCell::vertices
  std::vector<std::int32_t> vertex_director_nodes;             ///< director node of each vertex
  std::vector<std::size_t> edges_near_limit;  ///< edges within a factor 2 of the smooth angle, nearest first
  DirectorAngle largest_director_angle;
};

/// Finds the topology of a mesh in which find_flaws() finds no errors. Turns cells, so that a_3 has one direction in
/// each component: outwards if it is closed, otherwise that of the larger area of the file. `upper` decides first,
/// unless the mean normal is perpendicular to it. Throws SurfaceError for a surface with one side, and for cells that
/// fold back, touch at a point only, close on themselves, share a part of a side, or are degenerate.
SurfaceTopology surface_topology(SpaceMesh mesh, const SurfaceOptions& options);

/// Returns the edge between two nodes, or null.
const SurfaceEdge* find_edge(const SurfaceTopology& topology, std::array<int, 2> ends);

struct EdgeStatistics {
  std::size_t number = 0;
  double least_angle = 0, largest_angle = 0;  ///< [rad]
};

/// Numbers for the report.
struct SurfaceSummary {
  std::array<EdgeStatistics, 4> edges;  ///< by EdgeKind
  std::size_t lone_folds = 0, turned = 0;
  double area = 0;                                           ///< [m^2]
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();  ///< bounding box of the nodes [m]
  bool is_closed = false;                                    ///< all components are
  double volume = 0;  ///< enclosed by the closed components, with their signs [m^3]
};
SurfaceSummary summary_of(const SurfaceTopology& topology);

}  // namespace plastron::topology
