// Edges of a mesh in space, where sides of cells meet, and one orientation for cells that are connected through edges of two
// cells.
#pragma once
#include <plastron/topology/space_mesh.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace plastron::topology {

/// By number of cells and by angle: one cell; two cells; two cells; three or more cells.
enum class EdgeKind { border, smooth, fold, branch };

struct SurfaceEdge {
  std::array<int, 2> ends;  ///< nodes, ascending
  EdgeKind kind = EdgeKind::border;
  double angle = 0;  ///< largest between normals of two cells, over the nodes of the edge [rad]; border: 0
  std::size_t first_side = 0, side_count = 0;  ///< range of SurfaceTopology::sides
  /// A fold that no other edge continues at either end: it cannot be cut and counts as smooth.
  bool is_lone_fold = false;
};

/// The rule that chose the side to which a_3 points.
enum class SignRule { file, outward, upper };

/// Cells connected through edges of two cells: they have one orientation.
struct SurfaceComponent {
  std::size_t cells = 0, turned = 0;  ///< numbers
  double area = 0;                    ///< [m^2]
  bool is_closed = false;             ///< neither a border nor a branch
  double volume = 0;                  ///< enclosed, negative if a_3 points inwards [m^3]; 0 if not closed
  SignRule sign = SignRule::file;
};

struct Orientation {
  std::vector<bool> is_turned;  ///< cells whose coordinates must be swapped
  std::vector<int> component;   ///< of each cell
  std::vector<SurfaceComponent> components;
};

/// Finds the cells to turn, from the largest cell of a component outwards. `sides` are in the order of `edges`. Throws
/// SurfaceError if a component has one side only.
Orientation find_orientation(const SpaceMesh& mesh, std::span<const mesh::MeshEdge> sides,
                             std::span<const SurfaceEdge> edges, const std::optional<Vector3d>& upper);

}  // namespace plastron::topology
