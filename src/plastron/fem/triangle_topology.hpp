// A conforming mesh of triangles as every rank holds all of it: which vertices and edges a cell has, and how its
// refinement follows from numbers alone, without a search.
#pragma once
#include <plastron/fem/space.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace plastron::fem {

struct TriangleTopology {
  int vertex_count = 0;
  std::vector<std::array<int, 2>> edges{};  ///< their vertices
  std::vector<Cell> cells{};
  std::vector<std::array<int, 3>> vertices{};  ///< of each cell, anticlockwise
  std::vector<std::array<int, 3>> sides{};     ///< of each cell: edge s joins vertices s and s + 1
};

/// Precondition: a mesh of triangles.
TriangleTopology coarse_topology(const CoarseMesh& mesh);

/// Throws DomainError if a mesh with so many vertices, edges and cells has more edges or vertices, once refined, than 32 bits number.
void check_refinable(std::int64_t vertices, std::int64_t edges, std::int64_t cells);

/// Every cell c in four by the middles of its edges: cells 4c, 4c + 1, 4c + 2 keep its corner 0, 1, 2, cell 4c + 3 is
/// the middle one, turned by 180 degrees. The middle of edge e is vertex vertex_count + e. Throws what check_refinable() throws.
TriangleTopology refined(const TriangleTopology& mesh);

/// The square by which child k of a refined cell is seen: xi_parent = corner + size xi.
Cell child_cell(int child);

}  // namespace plastron::fem
