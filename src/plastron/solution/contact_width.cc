#include <plastron/solution/contact_width.hpp>

#include <algorithm>

namespace plastron::solution {

int ContactWidth::direction_across(std::size_t cell, std::size_t obstacle) const {
  const fem::Space& space = discrete_.space();
  if (space.shape() != mesh::Shape::quadrilateral) return 0;
  const auto nodes = space.nodes(cell);
  const auto n = static_cast<std::size_t>(space.degree) + 1;
  const auto differ = [&](std::size_t a, std::size_t b) {
    return touches(static_cast<std::size_t>(nodes[a]), obstacle) !=
                   touches(static_cast<std::size_t>(nodes[b]), obstacle)
               ? 1
               : 0;
  };
  int along_first = 0, along_second = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      along_first += differ(j * n + i, j * n + i + 1);
      along_second += differ(i * n + j, (i + 1) * n + j);
    }
  return along_first >= along_second ? 0 : 1;
}

bool ContactWidth::is_wider_than_a_line(std::size_t cell, std::size_t obstacle) const {
  if (discrete_.space().shape() != mesh::Shape::quadrilateral) return false;
  const auto nodes = discrete_.space().nodes(cell);
  const auto n = static_cast<std::size_t>(discrete_.space().degree) + 1;
  const bool along_first = direction_across(cell, obstacle) == 0;
  for (std::size_t line = 0; line < n; ++line) {
    const assembly::NodalPoint* first = nullptr;
    for (std::size_t i = 0; i < n; ++i) {
      const auto node = static_cast<std::size_t>(nodes[along_first ? line * n + i : i * n + line]);
      if (!touches(node, obstacle)) {
        first = nullptr;
      } else if (first == nullptr) {
        first = &discrete_.points[node];
      } else if ((discrete_.points[node].phi - first->phi).norm() > first->thickness / 2) {
        return true;
      }
    }
  }
  return false;
}

std::ptrdiff_t ContactWidth::touching_nodes(std::size_t cell, std::size_t obstacle) const {
  return std::ranges::count_if(discrete_.space().nodes(cell), [&](algebra::LocalIndex node) {
    return touches(static_cast<std::size_t>(node), obstacle);
  });
}

bool ContactWidth::is_full(std::size_t cell, std::size_t obstacle) const {
  return touching_nodes(cell, obstacle) == discrete_.space().nodes_per_cell();
}

template <class Belongs>
algebra::Vector ContactWidth::marked(const Belongs& belongs) const {
  const fem::Space& space = discrete_.space();
  const std::size_t obstacles = discrete_.obstacles.all.size();
  algebra::Vector marks(space.layout, static_cast<int>(obstacles));
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    for (std::size_t k = 0; k < obstacles; ++k)
      if (belongs(cell, k))
        for (const algebra::LocalIndex node : space.nodes(cell))
          marks.local()[static_cast<std::size_t>(node) * obstacles + k] += 1;
  marks.accumulate_ghosts();
  marks.update_ghosts();
  return marks;
}

bool ContactWidth::has_one_of(const algebra::Vector& marks, std::size_t cell, std::size_t obstacle) const {
  const std::size_t obstacles = discrete_.obstacles.all.size();
  return std::ranges::any_of(discrete_.space().nodes(cell), [&](algebra::LocalIndex node) {
    return marks.local()[static_cast<std::size_t>(node) * obstacles + obstacle] > 0;
  });
}

algebra::Vector ContactWidth::spread(const algebra::Vector& marks) const {
  return marked(
      [&](std::size_t cell, std::size_t k) { return touching_nodes(cell, k) > 0 && has_one_of(marks, cell, k); });
}

algebra::Vector ContactWidth::with_area() const {
  return spread(
      marked([&](std::size_t cell, std::size_t k) { return is_full(cell, k) || is_wider_than_a_line(cell, k); }));
}

algebra::Vector ContactWidth::with_inside() const {
  const algebra::Vector edge = marked([&](std::size_t cell, std::size_t k) { return !is_full(cell, k); });
  const algebra::Vector inside =
      marked([&](std::size_t cell, std::size_t k) { return is_full(cell, k) && !has_one_of(edge, cell, k); });
  return spread(
      marked([&](std::size_t cell, std::size_t k) { return is_full(cell, k) && has_one_of(inside, cell, k); }));
}

}  // namespace plastron::solution
