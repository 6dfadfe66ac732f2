// The corners of the cells, as nodes of a layout of their own.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/space.hpp>

#include <array>
#include <memory>
#include <vector>

namespace plastron::recovery {

/// Corners of cells seen by this rank, ordered as the nodes are.
class Vertices {
 public:
  /// (collective)
  explicit Vertices(const fem::Space& space);

  const std::shared_ptr<const algebra::Layout>& layout() const { return layout_; }
  /// The vertex of the corner-th corner of a cell of the space, an index of the layout; -1 at ghost cells, where this rank does not see it.
  algebra::LocalIndex at(const fem::Space& space, std::size_t cell, int corner) const {
    return vertex_of_node_[static_cast<std::size_t>(space.nodes(cell)[corner_node(corner)])];
  }

 private:
  std::size_t corner_node(int corner) const { return corner_nodes_[static_cast<std::size_t>(corner)]; }

  std::array<std::size_t, 4> corner_nodes_{};  // where a cell's corners stand among its nodes
  std::vector<algebra::LocalIndex> vertex_of_node_;
  std::shared_ptr<const algebra::Layout> layout_;
};

}  // namespace plastron::recovery
