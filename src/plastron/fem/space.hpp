// A finite element mesh of one level as plain arrays: cells, nodes and boundary sides on this rank.
//
// A cell is a dyadic part of its coarse cell; its map onto Omega is the coarse cell's exact map restricted to that
// part. Nodes are the Gauss-Lobatto points of degree k in a quadrilateral and equidistant in a triangle. There k <=
// 2, so they are Gauss-Lobatto points of every side. They are numbered lexicographically in a cell (xi_1 fastest).
#pragma once
#include <plastron/algebra/assertion.hpp>
#include <plastron/algebra/matrix.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/fem/rigid_body.hpp>
#include <plastron/mesh/coarse_mesh.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace plastron::fem {

using Eigen::Vector2d;

/// A cell: xi_coarse = corner + size xi. The size is negative for a triangle turned by 180 degrees against its coarse
/// cell.
struct Cell {
  int coarse = 0;                      ///< index of the coarse cell
  Vector2d corner = Vector2d::Zero();  ///< place of the cell's xi = 0 in the coarse cell's coordinates
  double size = 1;                     ///< side length in the coarse cell's coordinates, with the sign above
};

/// Place of a cell in integers: corner = (i, j) / |divisions| in its coarse cell, size = 1 / divisions.
using CellPlace = std::array<std::int32_t, 4>;  ///< coarse cell, divisions, i, j
inline CellPlace place_of(const Cell& cell) {
  const auto divisions = static_cast<std::int32_t>(std::lround(1 / cell.size));
  const auto in_parts = [&](double x) { return static_cast<std::int32_t>(std::lround(x * std::abs(divisions))); };
  return {cell.coarse, divisions, in_parts(cell.corner[0]), in_parts(cell.corner[1])};
}

/// A side of a cell on the boundary of the domain or on a named curve inside it. A side with several names is listed
/// once for each. A side on an inner curve is listed for one of its two cells (named_sides.hpp).
struct BoundarySide {
  std::size_t cell = 0;
  int side = 0;           ///< see reference_cell.hpp
  int boundary = -1;      ///< index into CoarseMesh::boundaries, -1 for an unnamed part of the domain's boundary
  bool is_inner = false;  ///< true with cells on both sides
};

/// A side of an owned cell along a hinge with a stiffness.
struct HingeSide {
  std::size_t cell = 0;
  int side = 0;
  std::vector<algebra::GlobalIndex> partners{};  ///< of the nodes of the side, on the other shell
  double stiffness = 0;                          ///< [N]
};

using ConstraintMap = constraints::Map;

struct Space {
  int degree = 1;
  std::shared_ptr<const mesh::CoarseMesh> coarse{};
  std::shared_ptr<const algebra::Layout> layout{};
  std::vector<Cell> cells{};  ///< owned cells first, then the ghost cells around them
  std::size_t owned_cells = 0;
  algebra::Connectivity connectivity{};  ///< nodes of all `cells`
  std::vector<BoundarySide> sides{};     ///< sides of all `cells`
  /// Sides of inner curves in the cells on their other side. Where cells differ in size, these have nodes that
  /// `sides` lacks.
  std::vector<BoundarySide> twin_sides{};
  /// Sides along folds and branches of a mesh in space. `boundary` is twice the index into CoarseMesh::folds, plus one for
  /// the second edge.
  std::vector<BoundarySide> fold_sides{};
  /// Constraints of every continuous field, with weights: a node that hangs on the side of a larger cell is
  /// interpolated from the nodes there, a node on a joined edge equals its partner (fem/constraints.hpp).
  ConstraintMap continuity{};
  /// Nodes where shells meet at an angle: the row names the node that determines their u.
  ConstraintMap kinks{};
  /// Constraints of (u, r): continuity, kinks and rigid bodies.
  ConstraintMap constraints{};
  std::vector<PlacedBody> bodies{};
  std::vector<HingeSide> hinges{};
  std::int64_t global_cells = 0;

  mesh::Shape shape() const { return coarse->shape; }
  int nodes_per_cell() const { return mesh::nodes_per_cell(shape(), degree); }
  std::span<const algebra::LocalIndex> nodes(std::size_t cell) const {
    PLASTRON_ASSERT(cell < cells.size(), cell, cells.size());
    return connectivity.element(cell);
  }
  /// Returns the nodes of the side in its direction, then their partners.
  std::vector<algebra::LocalIndex> nodes(const HingeSide& hinge) const;
  /// Returns the nodes on which the values in each cell and at each hinge depend, for the pattern of a matrix.
  algebra::Connectivity couplings() const;
};

}  // namespace plastron::fem
