// The boundaries of each side of a coarse cell, and the named sides of a level. A side may have several names. A side
// between two cells has its names in only one of them: the cell to the left of the edge in the direction of
// BoundaryEdge::vertices. A load on it then counts once, and its conormal has one direction.
#pragma once
#include <plastron/fem/space.hpp>

#include <vector>

namespace plastron::fem {

class NamedSides {
 public:
  explicit NamedSides(const mesh::CoarseMesh& coarse);

  /// Adds the named sides of the last cell in `space.cells`.
  void add_sides_of_last_cell(Space& space) const;

 private:
  mesh::Shape shape_;
  struct Side {
    std::vector<int> boundaries;  ///< indices into CoarseMesh::boundaries; only -1 on an unnamed part of the boundary
    std::vector<int> twin_boundaries{};  ///< boundaries listed by the cell on the other side
    std::vector<int> folds{};            ///< see Space::fold_sides
    bool is_inner = false;
  };
  Side& at(std::size_t coarse_cell, int side);

  std::vector<Side> sides_;  ///< sides of each coarse cell
};

}  // namespace plastron::fem
