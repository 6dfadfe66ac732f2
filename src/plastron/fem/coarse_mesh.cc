#include <plastron/fem/coarse_mesh.hpp>

#include <plastron/fem/grid_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plastron::fem {

namespace {

/// Points of a grid line. `breaks` divide the interval into pieces; each gets its share of the cells.
std::vector<double> grid_line(double from, double to, const std::vector<double>& breaks, int cells) {
  std::vector<double> ends(breaks);
  ends.push_back(to);
  std::vector<double> line{from};
  for (const double end : ends) {
    const double begin = line.back();
    const int pieces = std::max(1, static_cast<int>(std::lround(cells * (end - begin) / (to - from))));
    for (int i = 1; i <= pieces; ++i) line.push_back(begin + (end - begin) * i / pieces);
  }
  return line;
}

/// Returns numbers of cells that are nearly square, with at most eight along the longer side.
std::array<int, 2> default_cells(const Vector2d& size) {
  const double ratio = size[0] / size[1];
  const int along = std::clamp(static_cast<int>(std::lround(std::max(ratio, 1 / ratio))), 1, 8);
  return ratio >= 1 ? std::array{along, 1} : std::array{1, along};
}

CoarseMesh mesh_rectangle(const Rectangle& rectangle) {
  const auto automatic = default_cells(rectangle.to - rectangle.from);
  const int nx = rectangle.cells[0] > 0 ? rectangle.cells[0] : automatic[0];
  const int ny = rectangle.cells[1] > 0 ? rectangle.cells[1] : automatic[1];
  const auto xs = grid_line(rectangle.from[0], rectangle.to[0], rectangle.breaks, nx);
  const auto ys = grid_line(rectangle.from[1], rectangle.to[1], {}, ny);
  const auto region_at = [&](double x) {
    return static_cast<int>(std::ranges::count_if(rectangle.breaks, [&](double b) { return b < x; }));
  };

  std::vector<Vector2d> vertices;
  for (const double y : ys)
    for (const double x : xs) vertices.emplace_back(x, y);
  CoarseMesh mesh = grid_mesh(std::move(vertices), xs.size() - 1);
  mesh.regions = region_names(Domain{rectangle});
  mesh.boundaries = boundary_names(Domain{rectangle});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::size_t i = c % (xs.size() - 1);
    mesh.cells[c].region = region_at((xs[i] + xs[i + 1]) / 2);
  }
  return mesh;
}

CoarseMesh mesh_annulus(const Annulus& annulus) {
  return ring_mesh({annulus.centre, 0, annulus_sectors(annulus)}, std::array{annulus.inner, annulus.outer});
}

CoarseMesh of_shape(Shape shape, CoarseMesh quadrilaterals) {
  return shape == Shape::triangle ? cut_crosswise(std::move(quadrilaterals)) : quadrilaterals;
}

struct Mesher {
  Shape shape;
  CoarseMesh operator()(const Rectangle& d) const { return of_shape(shape, mesh_rectangle(d)); }
  CoarseMesh operator()(const Disk& d) const { return of_shape(shape, disk_mesh(d)); }
  CoarseMesh operator()(const Annulus& d) const { return of_shape(shape, mesh_annulus(d)); }
  CoarseMesh operator()(const Polygon& d) const { return mesh_polygon(d, shape); }
  CoarseMesh operator()(const MeshFile& d) const {
    return d.mesh && d.mesh->shape == shape ? *d.mesh : read_mesh_file(d, shape);
  }
};

}  // namespace

CoarseMesh coarse_mesh(const Domain& domain, Shape shape) { return std::visit(Mesher{shape}, domain); }

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
    mesh.cells.push_back({{quadrilateral.vertices[static_cast<std::size_t>(from)],
                           quadrilateral.vertices[static_cast<std::size_t>(to)], top, -1},
                          quadrilateral.region,
                          triangle_map(quadrilateral.map, corner(Shape::quadrilateral, from),
                                       corner(Shape::quadrilateral, to), middle)});
  }
}

}  // namespace plastron::fem
