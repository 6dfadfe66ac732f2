// A finite element mesh of one level as plain arrays: cells, nodes, boundary sides as this rank sees them.
//
// A cell is a dyadic part of its coarse cell, so its map onto Omega is the coarse cell's exact map restricted to that
// part. Nodes are the Gauss-Lobatto points of degree k in a quadrilateral and equidistant in a triangle, where k <= 2
// makes them Gauss-Lobatto points of every side; they are numbered lexicographically in a cell (xi_1 fastest).
#pragma once
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/matrix.hpp>
#include <plastron/fem/coarse_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace plastron::fem {

/// xi_coarse = corner + size xi. A triangle that is turned by 180 degrees against its coarse cell has a negative size.
struct Cell {
  int coarse = 0;                      ///< index of the coarse cell
  Vector2d corner = Vector2d::Zero();  ///< the cell's xi = 0 in the coarse cell's coordinates
  double size = 1;                     ///< side in the coarse cell's coordinates, with the sign above
};

/// Where a cell lies, in integers: corner = (i, j) / |divisions| in its coarse cell, size = 1 / divisions.
using CellPlace = std::array<std::int32_t, 4>;  ///< coarse cell, divisions, i, j
CellPlace place_of(const Cell& cell);

/// A side of a cell on the boundary of the domain or on a named curve inside of it. A side with several names is listed
/// once for each; a side on an inner curve is listed for one of its two cells (named_sides.hpp).
struct BoundarySide {
  std::size_t cell = 0;
  int side = 0;           ///< see reference_cell.hpp
  int boundary = -1;      ///< index into CoarseMesh::boundaries, -1 for an unnamed part of the domain's boundary
  bool is_inner = false;  ///< has cells on both sides
};

/// A node whose values are those of others, v = sum weight v_master: see ties.hpp. Masters are not tied themselves.
struct Tie {
  algebra::LocalIndex node = 0;
  std::vector<std::pair<algebra::LocalIndex, double>> masters{};
};

struct CarriedNodes;

struct Space {
  int degree = 1;
  std::shared_ptr<const CoarseMesh> coarse{};
  std::shared_ptr<const algebra::Layout> layout{};
  std::vector<Cell> cells{};  ///< owned cells first, then the ghost cells around them
  std::size_t owned_cells = 0;
  algebra::Connectivity connectivity{};  ///< nodes of all of `cells`
  std::vector<BoundarySide> sides{};     ///< of all of `cells`
  /// Of inner curves, seen from the cells on their other side: where cells differ in size these have nodes that `sides` has not.
  std::vector<BoundarySide> twin_sides{};
  std::vector<Tie> ties{};  ///< of all local nodes, ascending; their masters are local, too
  bool has_ties = false;    ///< on some rank
  /// Nodes whose (u, r) follow from others' by matrices, see carried_nodes.hpp; null where no rank has any.
  std::shared_ptr<const CarriedNodes> carried{};
  std::int64_t global_cells = 0;

  Shape shape() const { return coarse->shape; }
  int nodes_per_cell() const { return fem::nodes_per_cell(shape(), degree); }
  std::span<const algebra::LocalIndex> nodes(std::size_t cell) const {
    PLASTRON_ASSERT(cell < cells.size(), cell, cells.size());
    return connectivity.element(cell);
  }
};

}  // namespace plastron::fem
