// Rows of supports that one node hands to another, which may belong to another rank.
#pragma once
#include <plastron/algebra/layout.hpp>
#include <plastron/assembly/node_coordinates.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace plastron::assembly {

class HandedSupports {
 public:
  /// Directions with their values, in which u of the node `to` is held.
  void add_displacement(std::int64_t to, const std::vector<std::pair<Vector3d, double>>& rows, double scale) {
    add(to, false, rows, scale);
  }
  /// The same of r.
  void add_rotation(std::int64_t to, const std::vector<std::pair<Vector3d, double>>& rows, double scale) {
    add(to, true, rows, scale);
  }
  /// Adds what all ranks have handed to the supports of the owned nodes (collective).
  void deliver(const algebra::Layout& layout, std::vector<NodeSupport>& supports) const;

 private:
  void add(std::int64_t to, bool is_rotation, const std::vector<std::pair<Vector3d, double>>& rows, double scale);

  /// Of each row: node, 0 for u and 1 for r, direction, value, scale.
  std::vector<double> packed_{};
};

}  // namespace plastron::assembly
