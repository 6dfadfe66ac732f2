#include <plastron/domain/domain_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plastron::domain {

namespace {

using std::numbers::pi;

mesh::BlendedMap straight_map(const Vector2d& p00, const Vector2d& p10, const Vector2d& p01, const Vector2d& p11) {
  return {.left = mesh::Segment{p00, p01},
          .right = mesh::Segment{p10, p11},
          .bottom = mesh::Segment{p00, p10},
          .top = mesh::Segment{p01, p11}};
}

}  // namespace

mesh::CoarseMesh grid_mesh(std::vector<Vector2d> vertices, std::size_t columns) {
  mesh::CoarseMesh mesh;
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

mesh::CoarseMesh disk_mesh(const Disk& disk) {
  mesh::CoarseMesh mesh;
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
    const mesh::BlendedMap map{.left = mesh::Segment{at(k), at(next)},
                               .right = mesh::Arc{disk.centre, disk.radius, quarters.angle(k), quarters.angle(k + 1)},
                               .bottom = mesh::Segment{at(k), at(4 + k)},
                               .top = mesh::Segment{at(next), at(4 + next)}};
    mesh.cells.push_back({{k, 4 + k, next, 4 + next}, 0, {map}});
    mesh.edges.push_back({{4 + k, 4 + next}, 0});
  }
  return mesh;
}

void add_rings(const Rings& rings, std::span<const double> radii, std::vector<int> first, mesh::CoarseMesh& mesh) {
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
      const mesh::BlendedMap map{.left = mesh::Arc{rings.centre, radii[i], rings.angle(k), rings.angle(k + 1)},
                                 .right = mesh::Arc{rings.centre, radii[i + 1], rings.angle(k), rings.angle(k + 1)},
                                 .bottom = mesh::Segment{at(0), at(1)},
                                 .top = mesh::Segment{at(2), at(3)}};
      mesh.cells.push_back({v, 0, {map}});
    }
    near = std::move(far);
  }
}

mesh::CoarseMesh ring_mesh(const Rings& rings, std::span<const double> radii) {
  mesh::CoarseMesh mesh;
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

mesh::CoarseMesh mesh_rectangle(const Rectangle& rectangle) {
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
  mesh::CoarseMesh mesh = grid_mesh(std::move(vertices), xs.size() - 1);
  mesh.regions = region_names(Domain{rectangle});
  mesh.boundaries = boundary_names(Domain{rectangle});
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::size_t i = c % (xs.size() - 1);
    mesh.cells[c].region = region_at((xs[i] + xs[i + 1]) / 2);
  }
  return mesh;
}

mesh::CoarseMesh mesh_annulus(const Annulus& annulus) {
  return ring_mesh({annulus.centre, 0, annulus_sectors(annulus)}, std::array{annulus.inner, annulus.outer});
}

mesh::CoarseMesh of_shape(mesh::Shape shape, mesh::CoarseMesh quadrilaterals) {
  return shape == mesh::Shape::triangle ? mesh::cut_crosswise(std::move(quadrilaterals)) : quadrilaterals;
}

struct Mesher {
  mesh::Shape shape;
  mesh::CoarseMesh operator()(const Rectangle& d) const { return of_shape(shape, mesh_rectangle(d)); }
  mesh::CoarseMesh operator()(const Disk& d) const { return of_shape(shape, disk_mesh(d)); }
  mesh::CoarseMesh operator()(const Annulus& d) const { return of_shape(shape, mesh_annulus(d)); }
  mesh::CoarseMesh operator()(const Polygon& d) const { return mesh_polygon(d, shape); }
  mesh::CoarseMesh operator()(const MeshFile& d) const {
    return d.mesh && d.mesh->shape == shape ? *d.mesh : read_mesh_file(d, shape);
  }
};

}  // namespace

mesh::CoarseMesh coarse_mesh(const Domain& domain, mesh::Shape shape) { return std::visit(Mesher{shape}, domain); }

}  // namespace plastron::domain
