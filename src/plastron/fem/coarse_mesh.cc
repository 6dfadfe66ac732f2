#include <plastron/fem/coarse_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plastron::fem {

namespace {

using std::numbers::pi;

BlendedMap straight_map(const Vector2d& p00, const Vector2d& p10, const Vector2d& p01, const Vector2d& p11) {
  return {.left = Segment{p00, p01}, .right = Segment{p10, p11}, .bottom = Segment{p00, p10}, .top = Segment{p01, p11}};
}

/// Cells of a grid line: `breaks` cut the interval into pieces, each with its share of the cells.
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

/// As square as can be with at most eight cells along the longer side.
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
  const int columns = static_cast<int>(xs.size()) - 1, rows = static_cast<int>(ys.size()) - 1;
  const auto vertex = [&](int i, int j) { return j * (columns + 1) + i; };
  const auto region_at = [&](double x) {
    return static_cast<int>(std::ranges::count_if(rectangle.breaks, [&](double b) { return b < x; }));
  };

  CoarseMesh mesh;
  mesh.regions = rectangle.regions.empty() ? std::vector<std::string>{""} : rectangle.regions;
  mesh.boundaries = boundary_names(Domain{rectangle});
  for (const double y : ys)
    for (const double x : xs) mesh.vertices.emplace_back(x, y);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::array v{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)};
      const auto& p = mesh.vertices;
      mesh.cells.push_back({v, region_at((xs[i] + xs[i + 1]) / 2), {straight_map(p[v[0]], p[v[1]], p[v[2]], p[v[3]])}});
    }
  for (int j = 0; j < rows; ++j) {
    mesh.edges.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    mesh.edges.push_back({{vertex(columns, j), vertex(columns, j + 1)}, 1});
  }
  for (int i = 0; i < columns; ++i) {
    mesh.edges.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 2});
    mesh.edges.push_back({{vertex(i, rows), vertex(i + 1, rows)}, 3});
  }
  return mesh;
}

/// A square in the middle and four cells that run from its sides to the rim.
CoarseMesh mesh_disk(const Disk& disk) {
  CoarseMesh mesh;
  mesh.regions = {""};
  mesh.boundaries = {"rim"};
  const double half_diagonal = 0.45 * disk.radius;
  const auto corner_angle = [](int k) { return pi / 4 + pi / 2 * k; };
  const auto at = [&](double radius, int k) -> Vector2d {
    return disk.centre + radius * Vector2d(std::cos(corner_angle(k)), std::sin(corner_angle(k)));
  };
  for (int k = 0; k < 4; ++k) mesh.vertices.push_back(at(half_diagonal, k));
  for (int k = 0; k < 4; ++k) mesh.vertices.push_back(at(disk.radius, k));
  const auto& p = mesh.vertices;
  // Corners 0..3 lie at 45, 135, 225, 315 degrees, so the square's lexicographic order is 2, 3, 1, 0.
  mesh.cells.push_back({{2, 3, 1, 0}, 0, {straight_map(p[2], p[3], p[1], p[0])}});
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    // xi_1 runs outwards, xi_2 anticlockwise.
    const BlendedMap map{.left = Segment{p[k], p[next]},
                         .right = Arc{disk.centre, disk.radius, corner_angle(k), corner_angle(k) + pi / 2},
                         .bottom = Segment{p[k], p[4 + k]},
                         .top = Segment{p[next], p[4 + next]}};
    mesh.cells.push_back({{k, 4 + k, next, 4 + next}, 0, {map}});
    mesh.edges.push_back({{4 + k, 4 + next}, 0});
  }
  return mesh;
}

CoarseMesh mesh_annulus(const Annulus& annulus) {
  CoarseMesh mesh;
  mesh.regions = {""};
  mesh.boundaries = {"inner", "outer"};
  const double middle = (annulus.inner + annulus.outer) / 2, width = annulus.outer - annulus.inner;
  const int sectors = std::clamp(static_cast<int>(std::lround(2 * pi * middle / width / 2)) * 2, 6, 32);
  const auto angle = [&](int k) { return 2 * pi * k / sectors; };
  for (const double radius : {annulus.inner, annulus.outer})
    for (int k = 0; k < sectors; ++k)
      mesh.vertices.push_back(annulus.centre + radius * Vector2d(std::cos(angle(k)), std::sin(angle(k))));
  const auto& p = mesh.vertices;
  for (int k = 0; k < sectors; ++k) {
    const int next = (k + 1) % sectors, far = sectors + k, far_next = sectors + next;
    const BlendedMap map{.left = Arc{annulus.centre, annulus.inner, angle(k), angle(k + 1)},
                         .right = Arc{annulus.centre, annulus.outer, angle(k), angle(k + 1)},
                         .bottom = Segment{p[k], p[far]},
                         .top = Segment{p[next], p[far_next]}};
    mesh.cells.push_back({{k, far, next, far_next}, 0, {map}});
    mesh.edges.push_back({{k, next}, 0});
    mesh.edges.push_back({{far, far_next}, 1});
  }
  return mesh;
}

CoarseMesh of_shape(Shape shape, CoarseMesh quadrilaterals) {
  return shape == Shape::triangle ? cut_crosswise(std::move(quadrilaterals)) : quadrilaterals;
}

struct Mesher {
  Shape shape;
  CoarseMesh operator()(const Rectangle& d) const { return of_shape(shape, mesh_rectangle(d)); }
  CoarseMesh operator()(const Disk& d) const { return of_shape(shape, mesh_disk(d)); }
  CoarseMesh operator()(const Annulus& d) const { return of_shape(shape, mesh_annulus(d)); }
  CoarseMesh operator()(const Polygon& d) const { return mesh_polygon(d, shape); }
  CoarseMesh operator()(const MeshFile& d) const { return read_mesh_file(d, shape); }
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

/// The quadrilateral's map on the triangle p, q, middle of the unit square.
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
