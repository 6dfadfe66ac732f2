#include <plastron/topology/box_tree.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace plastron::topology {

BoxTree::BoxTree(std::vector<SpaceBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!boxes_.empty()) divide(0, boxes_.size());
}

void BoxTree::divide(std::size_t first, std::size_t end) {
  constexpr std::size_t leaf = 4;
  const std::size_t at = nodes_.size();
  nodes_.push_back({.box = {}, .first = first, .end = end});
  SpaceBox centres;
  const auto centre = [&](std::size_t i) { return Vector3d((boxes_[i].low + boxes_[i].high) / 2); };
  for (std::size_t i = first; i < end; ++i) {
    nodes_[at].box.add(boxes_[order_[i]]);
    centres.add(centre(order_[i]));
  }
  if (end - first <= leaf) return;
  Eigen::Index axis = 0;
  (centres.high - centres.low).maxCoeff(&axis);
  const std::size_t middle = first + (end - first) / 2;
  const auto place = [&](std::size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
  std::nth_element(place(first), place(middle), place(end), [&](std::size_t i, std::size_t j) {
    return std::pair(centre(i)[axis], i) < std::pair(centre(j)[axis], j);
  });
  divide(first, middle);
  nodes_[at].second = nodes_.size();
  divide(middle, end);
}

}  // namespace plastron::topology
