#include <plastron/fem/grid_mesh.hpp>

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
      const auto at = [&](std::size_t k) { return p[static_cast<std::size_t>(v[k])]; };
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
    const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
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
      const auto at = [&](std::size_t n) { return mesh.vertices[static_cast<std::size_t>(v[n])]; };
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

}  // namespace plastron::fem
