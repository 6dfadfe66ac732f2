#include <plastron/fem/named_sides.hpp>

#include <algorithm>

namespace plastron::fem {

namespace {

/// Whether both ends of a cell's side lie on the same side of the coarse cell. Coordinates are dyadic, hence exact.
bool lies_on_coarse_side(mesh::Shape shape, const Cell& cell, int side) {
  const auto distance = [&](int k) {
    const Vector2d xi = cell.corner + cell.size * mesh::corner(shape, k);
    if (shape == mesh::Shape::triangle) return side == 0 ? xi[1] : side == 1 ? 1 - xi[0] - xi[1] : xi[0];
    return side == 0 ? xi[0] : side == 1 ? 1 - xi[0] : side == 2 ? xi[1] : 1 - xi[1];
  };
  const auto [from, to] = mesh::side_corners(shape, side);
  return distance(from) == 0 && distance(to) == 0;
}

}  // namespace

NamedSides::Side& NamedSides::at(std::size_t coarse_cell, int side) {
  return sides_[coarse_cell * static_cast<std::size_t>(mesh::corner_count(shape_)) + static_cast<std::size_t>(side)];
}

NamedSides::NamedSides(const mesh::CoarseMesh& coarse)
    : shape_(coarse.shape), sides_(coarse.cells.size() * static_cast<std::size_t>(mesh::corner_count(coarse.shape))) {
  const auto edges = edges_of(coarse.cells);
  for (const mesh::BoundaryEdge& named : coarse.edges) {
    const auto [a, b] = named.vertices;
    const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
    const auto first = std::ranges::lower_bound(edges, ends, {}, &mesh::MeshEdge::ends);
    const auto last = std::ranges::upper_bound(edges, ends, {}, &mesh::MeshEdge::ends);
    for (auto edge = first; edge != last; ++edge)
      (last - first == 1 || edge->is_forward == (a < b) ? at(edge->cell, edge->side).boundaries
                                                        : at(edge->cell, edge->side).twin_boundaries)
          .push_back(named.boundary);
  }
  for (std::size_t fold = 0; fold < coarse.folds.size(); ++fold)
    for (std::size_t k = 0; k < 2; ++k) {
      const auto edge = std::ranges::lower_bound(edges, coarse.folds[fold].edges[k], {}, &mesh::MeshEdge::ends);
      PLASTRON_ASSERT(edge != edges.end() && edge->ends == coarse.folds[fold].edges[k], fold);
      at(edge->cell, edge->side).folds.push_back(static_cast<int>(2 * fold + k));
    }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Side& side = at(edges[i].cell, edges[i].side);
    side.is_inner =
        (i > 0 && edges[i - 1].ends == edges[i].ends) || (i + 1 < edges.size() && edges[i + 1].ends == edges[i].ends);
    // The shell does not end at a fold.
    side.is_inner = side.is_inner || !side.folds.empty();
    if (!side.is_inner && side.boundaries.empty()) side.boundaries.push_back(-1);
  }
}

void NamedSides::add_sides_of_last_cell(Space& space) const {
  const std::size_t last = space.cells.size() - 1;
  const Cell& cell = space.cells[last];
  const int sides = mesh::corner_count(shape_);
  for (int side = 0; side < sides; ++side) {
    const Side& coarse = sides_[static_cast<std::size_t>(cell.coarse) * static_cast<std::size_t>(sides) +
                                static_cast<std::size_t>(side)];
    if ((coarse.boundaries.empty() && coarse.twin_boundaries.empty() && coarse.folds.empty()) ||
        !lies_on_coarse_side(shape_, cell, side))
      continue;
    for (const int fold : coarse.folds) space.fold_sides.push_back({last, side, fold, true});
    for (const int boundary : coarse.boundaries) space.sides.push_back({last, side, boundary, coarse.is_inner});
    for (const int boundary : coarse.twin_boundaries) space.twin_sides.push_back({last, side, boundary, true});
  }
}

}  // namespace plastron::fem
