// A tree of boxes in space, for the search for things that are near each other.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace plastron::topology {

using Eigen::Vector3d;

struct SpaceBox {
  Vector3d low = Vector3d::Constant(HUGE_VAL), high = Vector3d::Constant(-HUGE_VAL);

  void add(const Vector3d& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  void add(const SpaceBox& box) {
    low = low.cwiseMin(box.low);
    high = high.cwiseMax(box.high);
  }
  SpaceBox widened(double margin) const { return {low.array() - margin, high.array() + margin}; }
  bool meets(const SpaceBox& box) const {
    return (low.array() <= box.high.array()).all() && (box.low.array() <= high.array()).all();
  }
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<SpaceBox> boxes);

  /// Calls `visit` with the indices of the boxes that meet the given one, always in the same order.
  template <class Visit>
  void visit(const SpaceBox& box, const Visit& visit) const {
    std::size_t stack[64], height = 0;  // halving leaves 64 levels for any number of boxes
    if (!nodes_.empty()) stack[height++] = 0;
    while (height > 0) {
      const std::size_t at = stack[--height];
      const Node& node = nodes_[at];
      if (!node.box.meets(box)) continue;
      if (node.second == 0) {
        for (std::size_t i = node.first; i < node.end; ++i)
          if (boxes_[order_[i]].meets(box)) visit(order_[i]);
      } else {
        stack[height++] = node.second;
        stack[height++] = at + 1;
      }
    }
  }

 private:
  /// The first child follows its parent; `second` is 0 at a leaf, which has order_[first] to order_[end - 1].
  struct Node {
    SpaceBox box;
    std::size_t first, end, second = 0;
  };
  void divide(std::size_t first, std::size_t end);

  std::vector<SpaceBox> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace plastron::topology
