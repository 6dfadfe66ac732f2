#include <plastron/mesh/coarse_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::mesh {

CoarseMesh cut_crosswise(CoarseMesh quadrilaterals) {
  CoarseMesh mesh = std::move(quadrilaterals);
  const auto cells = std::exchange(mesh.cells, {});
  mesh.shape = Shape::triangle;
  for (const CoarseCell& cell : cells) cut_crosswise(cell, mesh);
  return mesh;
}

namespace {

bool has_straight_sides(const CellMap& map) {
  if (const auto* lagrange = std::get_if<LagrangeMap>(&map.map)) return lagrange->order == 1;
  const auto* blended = std::get_if<BlendedMap>(&map.map);
  if (!blended) return false;
  const Edge* edges[] = {&blended->left, &blended->right, &blended->bottom, &blended->top};
  return std::ranges::all_of(edges, [](const Edge* e) { return std::holds_alternative<Segment>(*e); });
}

/// The quadrilateral's map on the triangle with the corners p, q and the middle of the unit square.
CellMap triangle_map(const CellMap& map, const Vector2d& p, const Vector2d& q, const Vector2d& middle) {
  if (has_straight_sides(map)) return {TriangleLagrangeMap{1, {map(p).value, map(q).value, map(middle).value}}};
  Eigen::Matrix2d axes;
  axes << q - p, middle - p;
  return {map.map, map.origin + map.axes * p, map.axes * axes};
}

}  // namespace

void cut_crosswise(const CoarseCell& quadrilateral, CoarseMesh& mesh) {
  const Vector2d middle(0.5, 0.5);
  const int top = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(quadrilateral.map(middle).value);
  constexpr std::array<int, 2> anticlockwise[4] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  for (const auto& [from, to] : anticlockwise) {
    mesh.cells.push_back(
        {{quadrilateral.vertices[from], quadrilateral.vertices[to], top, -1},
         quadrilateral.region,
         triangle_map(quadrilateral.map, corner(Shape::quadrilateral, from), corner(Shape::quadrilateral, to), middle),
         quadrilateral.patch});
  }
}

std::vector<MeshEdge> edges_of(const std::vector<CoarseCell>& cells) {
  std::vector<MeshEdge> edges;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Shape shape = shape_of(cells[c]);
    for (int side = 0; side < corner_count(shape); ++side) {
      const auto [from, to] = anticlockwise_corners(shape, side);
      const int a = cells[c].vertices[from], b = cells[c].vertices[to];
      edges.push_back({{std::min(a, b), std::max(a, b)}, c, side, a < b});
    }
  }
  std::ranges::stable_sort(edges, {}, &MeshEdge::ends);
  return edges;
}

std::vector<Vector2d> kept_nodes(const CoarseMesh& coarse, int degree) {
  std::vector<Vector2d> nodes;
  const std::vector<Vector2d> of_cell = lattice(coarse.shape, degree % 2 == 0 ? 2 : 1);
  for (const CoarseCell& cell : coarse.cells)
    for (const Vector2d& xi : of_cell) {
      const Vector2d at = cell.map(xi).value;
      nodes.push_back(coarse.patches ? address_of(cell.patch, at) : at);
    }
  return nodes;
}

double point_tolerance(const CoarseMesh& coarse) {
  if (coarse.patches) return 1e-9;
  Vector2d low = Vector2d::Constant(INFINITY), high = -low;
  for (const Vector2d& vertex : coarse.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return 1e-9 * (high - low).maxCoeff();
}

}  // namespace plastron::mesh
