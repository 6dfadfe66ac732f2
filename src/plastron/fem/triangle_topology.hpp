// A conforming mesh of triangles, stored completely on every rank: the vertices and edges of each cell. Its
// refinement follows from numbers alone, without a search.
#pragma once
#include <plastron/fem/space.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace plastron::fem {

struct TriangleTopology {
  int vertex_count = 0;
  std::vector<std::array<int, 2>> edges{};  ///< vertices of each edge
  std::vector<Cell> cells{};
  std::vector<std::array<int, 3>> vertices{};  ///< vertices of each cell, anticlockwise
  std::vector<std::array<int, 3>> sides{};     ///< edges of each cell: edge s joins vertices s and s + 1
};

/// Makes the topology of a coarse mesh. Precondition: a mesh of triangles.
TriangleTopology coarse_topology(const CoarseMesh& mesh);

/// Throws DomainError if a mesh of this size has, once refined, more edges or vertices than 32 bits can number.
void check_refinable(std::int64_t vertices, std::int64_t edges, std::int64_t cells);

/// Divides every cell c in four by the middles of its edges. Cells 4c, 4c + 1, 4c + 2 keep its corner 0, 1, 2. Cell
/// 4c + 3 is the middle one, turned by 180 degrees. The middle of edge e is vertex vertex_count + e. Throws the
/// exceptions of check_refinable().
TriangleTopology refined(const TriangleTopology& mesh);

/// The place of child k in its parent: xi_parent = corner + size xi.
Cell child_cell(int child);

}  // namespace plastron::fem
