// The sides of a mesh file's cells, found by their nodes.
#pragma once
#include <plastron/domain/mesh_data.hpp>

#include <array>
#include <vector>

namespace plastron::domain {

/// Nodes are indices in MeshData::nodes.
struct CellSide {
  std::array<std::int64_t, 2> ends;   ///< ascending
  std::array<std::int64_t, 2> drawn;  ///< in the direction of the first cell
  std::int64_t middle;                ///< -1 if there is none
  std::size_t cell;                   ///< first cell in the order of the file
  bool is_border = true;              ///< side of one cell only
  std::vector<int> groups{};
};

/// Sides of triangles and quadrilaterals of order 1 and 2. Two cells share a side if they share its ends.
class CellSides {
 public:
  CellSides() = default;
  /// Precondition: the elements are cells, and their nodes are numbered by number_nodes().
  explicit CellSides(const MeshData& data);

  /// All sides, ascending by ends.
  const std::vector<CellSide>& all() const { return sides_; }
  /// The side between two nodes; null if there is none.
  CellSide* between(std::int64_t a, std::int64_t b);
  /// Returns the border sides that have all of their nodes in the set. If no border side has, returns the sides between
  /// cells that have. Precondition: the set has no duplicates.
  std::vector<CellSide*> within(const std::vector<std::int64_t>& nodes);
  /// Number of the different nodes of these sides.
  std::size_t node_count(const std::vector<CellSide*>& sides);
  /// Number of cells that have this node.
  int cells_at(std::int64_t node) const { return cells_at_[node]; }

 private:
  std::vector<CellSide> sides_{};
  std::vector<int> cells_at_{};  ///< by node
  std::vector<char> mark_{};     ///< scratch, by node; 0 between calls
};

}  // namespace plastron::domain
