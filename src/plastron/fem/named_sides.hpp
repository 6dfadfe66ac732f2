// Which boundaries a side of a coarse cell belongs to, and from that the sides of a level. A side may carry several
// names. A side between two cells carries its names in one of them only, so that a load on it counts once and its
// conormal has one direction: in the cell to the left of the edge as BoundaryEdge::vertices runs.
#pragma once
#include <plastron/fem/space.hpp>

#include <vector>

namespace plastron::fem {

class NamedSides {
 public:
  explicit NamedSides(const CoarseMesh& coarse);

  /// Adds the named sides of the cell that stands last in `space.cells`.
  void add_sides_of_last_cell(Space& space) const;

 private:
  Shape shape_;
  struct Side {
    std::vector<int> boundaries;  ///< indices into CoarseMesh::boundaries; -1 alone on an unnamed part of the boundary
    std::vector<int> twin_boundaries{};  ///< those that the cell on the other side lists
    bool is_inner = false;
  };
  Side& at(std::size_t coarse_cell, int side);

  std::vector<Side> sides_;  ///< of each coarse cell
};

}  // namespace plastron::fem
