// Rows of supports that one node passes to another node, which may belong to another rank.
#pragma once
#include <plastron/algebra/layout.hpp>
#include <plastron/assembly/node_coordinates.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace plastron::assembly {

class HandedSupports {
 public:
  /// Adds directions and values in which u of the node `to` is prescribed.
  void add_displacement(std::int64_t to, const std::vector<std::pair<Vector3d, double>>& rows, double scale) {
    add(to, false, rows, scale);
  }
  /// Adds directions and values in which r of the node `to` is prescribed.
  void add_rotation(std::int64_t to, const std::vector<std::pair<Vector3d, double>>& rows, double scale) {
    add(to, true, rows, scale);
  }
  /// Adds the rows that all ranks have passed to the supports of the owned nodes (collective).
  void deliver(const algebra::Layout& layout, std::vector<NodeSupport>& supports) const;

 private:
  void add(std::int64_t to, bool is_rotation, const std::vector<std::pair<Vector3d, double>>& rows, double scale);

  /// Data of each row: node, 0 for u and 1 for r, direction, value, scale.
  std::vector<double> packed_{};
};

}  // namespace plastron::assembly
