// Checks the sides of obstacles. Deep inside a body the nearest way out may change its side from node to node, as in
// the middle of a slab. Then gaps push one cell to both sides, and the free side is arbitrary. Outside the body such a
// jump is harmless.
#include <plastron/examination/checks.hpp>

#include <optional>
#include <utility>

namespace plastron::examination {

namespace {

/// Limit of the cosine between normals that push to opposite sides: 120 degrees.
constexpr double opposite = -0.5;

/// Returns two nodes of one cell inside the obstacle that it pushes to opposite sides.
std::optional<std::pair<std::size_t, std::size_t>> pushed_apart(const Examined& examined,
                                                                const std::vector<obstacle::Gap>& gaps, double inside) {
  for (std::size_t cell = 0; cell < examined.space->cells.size(); ++cell) {
    const auto nodes = examined.space->nodes(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i && gaps[nodes[i]].initial < inside; ++j)
        if (gaps[nodes[j]].initial < inside && gaps[nodes[i]].normal.dot(gaps[nodes[j]].normal) < opposite)
          return std::pair(nodes[j], nodes[i]);
  }
  return {};
}

}  // namespace

void check_sides(Examined& examined, const ExaminedNodes& nodes, std::size_t obstacle) {
  const auto& gaps = nodes.coordinates.gaps[obstacle];
  const auto pair = pushed_apart(examined, gaps, -1e-9 * examined.size);
  if (!pair) return;
  const auto [a, b] = *pair;
  examined.add(
      Severity::warning,
      "it is not clear which side of {} is the free one: the way out of it that is nearest is along {} at {}, "
      "but along {} at {} beside it, and the shell is pushed both ways; let all of the shell that is inside be "
      "nearer to one side, or let the obstacle come in by [[step]]s",
      obstacle_text(examined.problem, obstacle), vector_text(gaps[a].normal), examined.place(nodes.points[a].x),
      vector_text(gaps[b].normal), examined.place(nodes.points[b].x));
}

}  // namespace plastron::examination
