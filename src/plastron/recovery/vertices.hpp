// The corners of the cells as nodes of a separate layout.
#pragma once
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/space.hpp>

#include <array>
#include <memory>
#include <vector>

namespace plastron::recovery {

/// Corners of cells on this rank, in the order of the nodes.
class Vertices {
 public:
  /// Numbers the vertices (collective).
  explicit Vertices(const fem::Space& space);

  const std::shared_ptr<const algebra::Layout>& layout() const { return layout_; }
  /// Index in the layout of the vertex at a corner of a cell; -1 at ghost cells whose vertex this rank does not have.
  algebra::LocalIndex at(const fem::Space& space, std::size_t cell, int corner) const {
    return vertex_of_node_[static_cast<std::size_t>(space.nodes(cell)[corner_node(corner)])];
  }

 private:
  std::size_t corner_node(int corner) const { return corner_nodes_[static_cast<std::size_t>(corner)]; }

  std::array<std::size_t, 4> corner_nodes_{};  // places of a cell's corners among its nodes
  std::vector<algebra::LocalIndex> vertex_of_node_;
  std::shared_ptr<const algebra::Layout> layout_;
};

}  // namespace plastron::recovery
