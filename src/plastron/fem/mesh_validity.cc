#include <plastron/fem/mesh_validity.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace plastron::fem {

namespace {

class Examiner {
 public:
  Examiner(const FileCells& cells, const std::vector<MeshEdge>& edges, const std::string& source)
      : cells_(cells), edges_(edges), source_(source) {}

  void run() const {
    cells_differ();
    std::vector<MeshEdge> boundary;
    for (std::size_t i = 0; i < edges_.size();) {
      std::size_t end = i + 1;
      while (end < edges_.size() && edges_[end].ends == edges_[i].ends) ++end;
      join(std::span(edges_).subspan(i, end - i));
      if (end == i + 1) boundary.push_back(edges_[i]);
      i = end;
    }
    if (const auto hanging = find_hanging_vertex(cells_.mesh, boundary)) refuse_hanging(*hanging);
    if (const auto pair = find_overlap(cells_.mesh))
      refuse(fmt::format("{} and {} overlap near {}; cells must lie side by side", element((*pair)[0]),
                         element((*pair)[1]), place(centre_of((*pair)[0]))));
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw DomainError(source_ + ": " + what); }
  std::string element(std::size_t cell) const { return place_of(*cells_.elements[cell]); }
  static std::string place(const Vector2d& x) { return fmt::format("({:.6g}, {:.6g})", x[0], x[1]); }
  const Vector2d& vertex(int v) const { return cells_.mesh.vertices[static_cast<std::size_t>(v)]; }
  Vector2d centre_of(std::size_t cell) const {
    const CoarseCell& c = cells_.mesh.cells[cell];
    return c.map(centre(shape_of(c))).value;
  }

  void cells_differ() const {
    std::vector<std::pair<std::array<int, 4>, std::size_t>> corners;
    for (std::size_t c = 0; c < cells_.mesh.cells.size(); ++c) {
      auto v = cells_.mesh.cells[c].vertices;
      std::ranges::sort(v);
      corners.emplace_back(v, c);
    }
    std::ranges::sort(corners);
    const auto twice =
        std::ranges::adjacent_find(corners, [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != corners.end())
      refuse(fmt::format("{} and {} are the same cell, at {}; it must stand once, in one physical surface",
                         element(twice->second), element(std::next(twice)->second), place(centre_of(twice->second))));
  }

  /// All cells are anticlockwise, so neighbours run along their common side in opposite directions.
  void join(std::span<const MeshEdge> same) const {
    const Vector2d &a = vertex(same[0].ends[0]), &b = vertex(same[0].ends[1]);
    if (same.size() > 2)
      refuse(fmt::format("{} cells meet at the side from {} to {}: {}, {}, {}; two are most", same.size(), place(a),
                         place(b), element(same[0].cell), element(same[1].cell), element(same[2].cell)));
    if (same.size() == 2 && same[0].is_forward == same[1].is_forward)
      refuse(fmt::format("{} and {} lie on the same side of their common side from {} to {}: they overlap",
                         element(same[0].cell), element(same[1].cell), place(a), place(b)));
  }

  [[noreturn]] void refuse_hanging(const HangingVertex& h) const {
    refuse(fmt::format(
        "a corner at {} lies inside of the side from {} to {} of {}: a hanging node, where the mesh is not "
        "joined; neighbouring cells must share whole sides",
        place(vertex(h.vertex)), place(vertex(h.edge.ends[0])), place(vertex(h.edge.ends[1])), element(h.edge.cell)));
  }

  const FileCells& cells_;
  const std::vector<MeshEdge>& edges_;
  const std::string& source_;
};

}  // namespace

std::vector<MeshEdge> edges_of(const std::vector<CoarseCell>& cells) {
  std::vector<MeshEdge> edges;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Shape shape = shape_of(cells[c]);
    for (int side = 0; side < corner_count(shape); ++side) {
      const auto [from, to] = anticlockwise_corners(shape, side);
      const int a = cells[c].vertices[static_cast<std::size_t>(from)],
                b = cells[c].vertices[static_cast<std::size_t>(to)];
      edges.push_back({{std::min(a, b), std::max(a, b)}, c, side, a < b});
    }
  }
  std::ranges::stable_sort(edges, {}, &MeshEdge::ends);
  return edges;
}

void check_cells_fit(const FileCells& cells, const std::vector<MeshEdge>& edges, const std::string& source) {
  Examiner(cells, edges, source).run();
}

}  // namespace plastron::fem
