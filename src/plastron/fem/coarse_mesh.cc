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

}  // namespace

CoarseMesh grid_mesh(std::vector<Vector2d> vertices, std::size_t columns) {
  CoarseMesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.regions = {""};
  const auto& p = mesh.vertices;
  const std::size_t rows = p.size() / (columns + 1) - 1;
  const auto vertex = [&](std::size_t i, std::size_t j) { return static_cast<int>(j * (columns + 1) + i); };
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const std::array v{vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)};
      const auto at = [&](std::size_t k) { return p[v[k]]; };
      mesh.cells.push_back({v, 0, {straight_map(at(0), at(1), at(2), at(3))}});
    }
  for (std::size_t j = 0; j < rows; ++j) {
    mesh.edges.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    mesh.edges.push_back({{vertex(columns, j), vertex(columns, j + 1)}, 1});
  }
  for (std::size_t i = 0; i < columns; ++i) {
    mesh.edges.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 2});
    mesh.edges.push_back({{vertex(i, rows), vertex(i + 1, rows)}, 3});
  }
  return mesh;
}

double Rings::angle(int k) const { return first_angle + 2 * pi * k / sectors; }

Vector2d Rings::at(double radius, int k) const {
  return centre + radius * Vector2d(std::cos(angle(k)), std::sin(angle(k)));
}

CoarseMesh disk_mesh(const Disk& disk) {
  CoarseMesh mesh;
  mesh.regions = {""};
  mesh.boundaries = {"rim"};
  const Rings quarters{disk.centre, pi / 4, 4};
  for (const double radius : {0.45 * disk.radius, disk.radius})
    for (int k = 0; k < 4; ++k) mesh.vertices.push_back(quarters.at(radius, k));
  const auto& p = mesh.vertices;
  // Corners 0..3 lie at 45, 135, 225, 315 degrees; the square's lexicographic order is therefore 2, 3, 1, 0.
  mesh.cells.push_back({{2, 3, 1, 0}, 0, {straight_map(p[2], p[3], p[1], p[0])}});
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    const auto at = [&](int i) { return p[i]; };
    // xi_1 runs outwards, xi_2 anticlockwise.
    const BlendedMap map{.left = Segment{at(k), at(next)},
                         .right = Arc{disk.centre, disk.radius, quarters.angle(k), quarters.angle(k + 1)},
                         .bottom = Segment{at(k), at(4 + k)},
                         .top = Segment{at(next), at(4 + next)}};
    mesh.cells.push_back({{k, 4 + k, next, 4 + next}, 0, {map}});
    mesh.edges.push_back({{4 + k, 4 + next}, 0});
  }
  return mesh;
}

void add_rings(const Rings& rings, std::span<const double> radii, std::vector<int> first, CoarseMesh& mesh) {
  std::vector<int> near = std::move(first);
  for (std::size_t i = 0; i + 1 < radii.size(); ++i) {
    std::vector<int> far;
    for (int k = 0; k < rings.sectors; ++k) {
      far.push_back(static_cast<int>(mesh.vertices.size()));
      mesh.vertices.push_back(rings.at(radii[i + 1], k));
    }
    for (int k = 0; k < rings.sectors; ++k) {
      const auto here = static_cast<std::size_t>(k), next = static_cast<std::size_t>((k + 1) % rings.sectors);
      const std::array v{near[here], far[here], near[next], far[next]};
      const auto at = [&](std::size_t n) { return mesh.vertices[v[n]]; };
      const BlendedMap map{.left = Arc{rings.centre, radii[i], rings.angle(k), rings.angle(k + 1)},
                           .right = Arc{rings.centre, radii[i + 1], rings.angle(k), rings.angle(k + 1)},
                           .bottom = Segment{at(0), at(1)},
                           .top = Segment{at(2), at(3)}};
      mesh.cells.push_back({v, 0, {map}});
    }
    near = std::move(far);
  }
}

CoarseMesh ring_mesh(const Rings& rings, std::span<const double> radii) {
  CoarseMesh mesh;
  mesh.regions = {""};
  mesh.boundaries = {"inner", "outer"};
  std::vector<int> first;
  for (int k = 0; k < rings.sectors; ++k) {
    first.push_back(k);
    mesh.vertices.push_back(rings.at(radii.front(), k));
  }
  add_rings(rings, radii, first, mesh);
  const int last = static_cast<int>(mesh.vertices.size()) - rings.sectors;
  for (int k = 0; k < rings.sectors; ++k) {
    const int next = (k + 1) % rings.sectors;
    mesh.edges.push_back({{k, next}, 0});
    mesh.edges.push_back({{last + k, last + next}, 1});
  }
  return mesh;
}

int annulus_sectors(const Annulus& annulus) {
  const double middle = (annulus.inner + annulus.outer) / 2, width = annulus.outer - annulus.inner;
  return std::clamp(static_cast<int>(std::lround(2 * pi * middle / width / 2)) * 2, 6, 32);
}

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

}  // namespace plastron::fem
