// Nested meshes of triangles with elements of degree 1 and 2 (docs/decisions/0007-triangles.md). Every rank holds the
// topology of the whole mesh; cells are dealt out in contiguous blocks in the order of refinement, and a node belongs
// to the lowest rank that has a cell with it. Nodes are numbered as the cells name them first, so that the numbers do
// not depend on how many ranks there are.
#pragma once
#include <plastron/fem/named_sides.hpp>
#include <plastron/fem/triangle_topology.hpp>

#include <mpi.h>

#include <memory>
#include <span>
#include <vector>

namespace plastron::fem {

/// The numbers of all nodes of a mesh and the ranges of the ranks.
struct TriangleNumbering {
  std::vector<algebra::GlobalIndex> number{};      ///< of vertices and, for degree 2, behind them of edges
  std::vector<std::size_t> first_cell{};           ///< of each rank, and the count of all cells at the end
  std::vector<algebra::GlobalIndex> first_node{};  ///< likewise
};

class TriangleSequence {
 public:
  /// The coarsest level (collective). Throws DomainError for degrees other than 1 and 2.
  TriangleSequence(CoarseMesh coarse, int degree, MPI_Comm comm);

  std::shared_ptr<const Space> space() const { return space_; }
  /// See MeshSequence::refine.
  void refine(std::span<algebra::Vector> fields);

 private:
  void flatten();
  void add_cell(std::size_t cell, Space& target) const;
  /// What the mesh was.
  struct Refinement {
    TriangleTopology mesh;
    TriangleNumbering numbers;
  };
  /// That of the space, with all nodes of the parents of the cells that this rank will have as ghosts (collective).
  std::shared_ptr<const algebra::Layout> layout_of_parents() const;
  /// `coarse` is on layout_of_parents(), with its ghosts' values (collective).
  algebra::Vector interpolated(const algebra::Vector& coarse, const Refinement& from) const;

  std::shared_ptr<const CoarseMesh> coarse_;
  int degree_;
  MPI_Comm comm_;
  int rank_ = 0, ranks_ = 1;
  NamedSides sides_;
  TriangleTopology mesh_;
  TriangleNumbering numbers_;
  std::shared_ptr<const Space> space_;
};

}  // namespace plastron::fem
