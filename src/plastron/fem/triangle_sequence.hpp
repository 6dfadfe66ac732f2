// Nested meshes of triangles with elements of degree 1 and 2 (docs/decisions/0007-triangles.md). Every rank stores
// the topology of the whole mesh. Ranks own contiguous blocks of cells in the order of refinement. A node belongs to
// the lowest rank that owns a cell with it. Nodes are numbered in the order of their first occurrence in the cells,
// so that the numbers do not depend on the number of ranks.
#pragma once
#include <plastron/fem/named_sides.hpp>

#include <mpi.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace plastron::fem {

/// A conforming mesh of triangles, stored completely on every rank. Its refinement follows from numbers alone, without
/// a search.
struct TriangleTopology {
  int vertex_count = 0;
  std::vector<std::array<int, 2>> edges{};  ///< vertices of each edge
  std::vector<Cell> cells{};
  std::vector<std::array<int, 3>> vertices{};  ///< vertices of each cell, anticlockwise
  std::vector<std::array<int, 3>> sides{};     ///< edges of each cell: edge s joins vertices s and s + 1
};

/// Makes the topology of a coarse mesh. Precondition: a mesh of triangles.
TriangleTopology coarse_topology(const mesh::CoarseMesh& mesh);

/// Throws DomainError if a mesh of this size has, once refined, more edges or vertices than 32 bits can number.
void check_refinable(std::int64_t vertices, std::int64_t edges, std::int64_t cells);

/// Divides every cell c in four by the middles of its edges. Cells 4c, 4c + 1, 4c + 2 keep its corner 0, 1, 2. Cell
/// 4c + 3 is the middle one, turned by 180 degrees. The middle of edge e is vertex vertex_count + e. Throws the
/// exceptions of check_refinable().
TriangleTopology refined(const TriangleTopology& mesh);

/// The place of child k in its parent: xi_parent = corner + size xi.
Cell child_cell(int child);

/// Numbers of all nodes of a mesh and the ranges of the ranks.
struct TriangleNumbering {
  std::vector<algebra::GlobalIndex> number{};      ///< numbers of vertices and, for degree 2, of edges after them
  std::vector<std::size_t> first_cell{};           ///< first cell of each rank, and the number of all cells at the end
  std::vector<algebra::GlobalIndex> first_node{};  ///< first node of each rank, likewise
};

class TriangleSequence {
 public:
  /// Makes the coarsest level (collective). Throws DomainError for degrees other than 1 and 2.
  TriangleSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm);

  std::shared_ptr<const Space> space() const { return space_; }
  /// See MeshSequence::refine.
  void refine(std::span<algebra::Vector> fields);

 private:
  void flatten();
  void add_cell(std::size_t cell, Space& target) const;
  /// The mesh before a refinement.
  struct Refinement {
    TriangleTopology mesh;
    TriangleNumbering numbers;
  };
  /// The space's layout plus, as ghosts, all nodes of the parents of this rank's next cells (collective).
  std::shared_ptr<const algebra::Layout> layout_of_parents() const;
  /// Interpolates `coarse`, which is on layout_of_parents() with its ghosts' values (collective).
  algebra::Vector interpolated(const algebra::Vector& coarse, const Refinement& from) const;

  std::shared_ptr<const mesh::CoarseMesh> coarse_;
  int degree_;
  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  NamedSides sides_;
  TriangleTopology mesh_;
  TriangleNumbering numbers_;
  std::shared_ptr<const Space> space_;
};

}  // namespace plastron::fem
