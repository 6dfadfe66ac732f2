#include <plastron/meshing/chords.hpp>

#include <plastron/algebra/assertion.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace plastron::meshing {

namespace {

/// Disjoint sets of cell directions that must be divided together.
class Union {
 public:
  explicit Union(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

Chords chords(const fem::CoarseMesh& mesh) {
  PLASTRON_ASSERT(mesh.shape == fem::Shape::quadrilateral);
  Union sets(2 * mesh.cells.size());
  std::map<std::pair<int, int>, std::size_t> cut;  // sides, each with the cell direction that cuts it
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int side = 0; side < 4; ++side) {
      const auto [from, to] = fem::side_corners(fem::Shape::quadrilateral, side);
      const auto ends = std::minmax(mesh.cells[c].vertices[static_cast<std::size_t>(from)],
                                    mesh.cells[c].vertices[static_cast<std::size_t>(to)]);
      const std::size_t direction = 2 * c + (side < 2 ? 1 : 0);
      const auto [other, is_new] = cut.try_emplace(ends, direction);
      if (!is_new) sets.join(other->second, direction);
    }
  Chords result;
  std::map<std::size_t, int> numbers;
  const auto number = [&](std::size_t direction) {
    return numbers.try_emplace(sets.find(direction), static_cast<int>(numbers.size())).first->second;
  };
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const int first = number(2 * c);
    result.of_cell.push_back({first, number(2 * c + 1)});
  }
  result.count = static_cast<int>(numbers.size());
  return result;
}

}  // namespace plastron::meshing
