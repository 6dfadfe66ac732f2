#include <plastron/domain/cell_sides.hpp>

#include <algorithm>

namespace plastron::domain {

CellSides::CellSides(const MeshData& data) : cells_at_(data.nodes.size()), mark_(data.nodes.size()) {
  for (std::size_t c = 0; c < data.elements.size(); ++c) {
    const ElementType type = *element_type(data.elements[c].type);
    const std::int64_t* nodes = data.element_nodes.data() + data.elements[c].first_node;
    for (int i = 0; i < type.nodes; ++i) ++cells_at_[nodes[i]];
    const int corners = type.family == ElementFamily::triangle ? 3 : 4;
    for (int i = 0; i < corners; ++i) {
      const std::array<std::int64_t, 2> drawn{nodes[i], nodes[(i + 1) % corners]};
      sides_.push_back({{std::min(drawn[0], drawn[1]), std::max(drawn[0], drawn[1])},
                        drawn,
                        type.order > 1 ? nodes[corners + i] : -1,
                        c});
    }
  }
  std::ranges::stable_sort(sides_, {}, &CellSide::ends);
  std::size_t kept = 0;
  for (const CellSide& side : sides_)
    if (kept > 0 && sides_[kept - 1].ends == side.ends)
      sides_[kept - 1].is_border = false;
    else
      sides_[kept++] = side;
  sides_.erase(sides_.begin() + static_cast<std::ptrdiff_t>(kept), sides_.end());
}

CellSide* CellSides::between(std::int64_t a, std::int64_t b) {
  const std::array<std::int64_t, 2> ends{std::min(a, b), std::max(a, b)};
  const auto found = std::ranges::lower_bound(sides_, ends, {}, &CellSide::ends);
  return found != sides_.end() && found->ends == ends ? &*found : nullptr;
}

std::vector<CellSide*> CellSides::within(const std::vector<std::int64_t>& nodes) {
  for (const std::int64_t node : nodes) mark_[node] = 1;
  std::vector<CellSide*> border, inner;
  for (const std::int64_t node : nodes) {
    auto side = std::ranges::lower_bound(sides_, std::array<std::int64_t, 2>{node, -1}, {}, &CellSide::ends);
    for (; side != sides_.end() && side->ends[0] == node; ++side)
      if (mark_[side->ends[1]] != 0 && (side->middle < 0 || mark_[side->middle] != 0))
        (side->is_border ? border : inner).push_back(&*side);
  }
  for (const std::int64_t node : nodes) mark_[node] = 0;
  return border.empty() ? inner : border;
}

std::size_t CellSides::node_count(const std::vector<CellSide*>& sides) {
  std::vector<std::int64_t> nodes;
  for (const CellSide* side : sides)
    for (const std::int64_t node : {side->ends[0], side->ends[1], side->middle})
      if (node >= 0 && mark_[node] == 0) {
        mark_[node] = 1;
        nodes.push_back(node);
      }
  for (const std::int64_t node : nodes) mark_[node] = 0;
  return nodes.size();
}

}  // namespace plastron::domain
