// A finite element mesh of one level as plain arrays: cells, nodes, boundary faces as this rank sees them.
//
// A cell is a dyadic sub-square of its coarse cell, so its map onto Omega is the coarse cell's exact map restricted to
// that square. Nodes are the Gauss-Lobatto points of degree k, numbered lexicographically in a cell (xi_1 fastest).
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/fem/coarse_mesh.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace plastron::fem {

struct Cell {
  int coarse = 0;                      ///< index of the coarse cell
  Vector2d corner = Vector2d::Zero();  ///< lower left corner in the coarse cell's coordinates
  double size = 1;                     ///< side in the coarse cell's coordinates
};

/// Sides of the unit square: 0: xi_1 = 0, 1: xi_1 = 1, 2: xi_2 = 0, 3: xi_2 = 1.
struct BoundaryFace {
  std::size_t cell = 0;
  int side = 0;
  int boundary = -1;  ///< index into CoarseMesh::boundaries, -1 for an unnamed part
};

struct Space {
  int degree = 1;
  std::shared_ptr<const CoarseMesh> coarse{};
  std::shared_ptr<const algebra::Layout> layout{};
  std::vector<Cell> cells{};  ///< owned cells first, then the ghost cells around them
  std::size_t owned_cells = 0;
  algebra::Connectivity connectivity{};  ///< nodes of all of `cells`
  std::vector<BoundaryFace> faces{};     ///< of all of `cells`
  std::int64_t global_cells = 0;

  int nodes_per_cell() const { return (degree + 1) * (degree + 1); }
  std::span<const algebra::LocalIndex> nodes(std::size_t cell) const { return connectivity.element(cell); }
};

/// Lexicographic indices of the nodes on a side of a cell, in the direction of the increasing coordinate.
std::vector<int> side_nodes(int degree, int side);
/// The point of the unit square at parameter t of a side.
Vector2d side_point(int side, double t);

}  // namespace plastron::fem
