// An edge of a mesh in space, where sides of cells meet.
#pragma once
#include <plastron/topology/space_mesh.hpp>

#include <array>
#include <cstddef>

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

}  // namespace plastron::topology
