// Meshes in space for tests: images of a grid, glued together.
#pragma once
#include <plastron/topology/space_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace plastron::topology::space_meshes {

using std::numbers::pi;

inline constexpr mesh::Shape shapes[] = {mesh::Shape::quadrilateral, mesh::Shape::triangle};

/// The size of a grid over the unit square and the order of its cells.
struct Grid {
  int columns = 1, rows = 1, order = 1;
};

/// Adds the image of a grid with its own nodes. Triangles are halves of its squares.
template <class Map>
void add_grid(const Grid& grid, const Map& map, SpaceMesh& mesh) {
  const auto first = static_cast<std::int32_t>(mesh.nodes.size());
  const int q = grid.order, width = grid.columns * q + 1;
  for (int j = 0; j <= grid.rows * q; ++j)
    for (int i = 0; i < width; ++i)
      mesh.nodes.push_back(map(static_cast<double>(i) / (grid.columns * q), static_cast<double>(j) / (grid.rows * q)));
  const auto add_cell = [&](int column, int row, bool is_upper) {
    SurfaceCell cell{.nodes = {}, .order = q, .tag = static_cast<std::int64_t>(mesh.cells.size() + 1)};
    const int corner = is_upper ? q : 0, step = is_upper ? -1 : 1;
    for (int j = 0; j <= q; ++j)
      for (int i = 0; i <= (mesh.shape == mesh::Shape::triangle ? q - j : q); ++i)
        cell.nodes.push_back(first + (row * q + corner + step * j) * width + column * q + corner + step * i);
    mesh.cells.push_back(cell);
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      add_cell(column, row, false);
      if (mesh.shape == mesh::Shape::triangle) add_cell(column, row, true);
    }
}

/// Joins grids whose nodes coincide.
inline SpaceMesh glued(SpaceMesh mesh) {
  const double tolerance = merge_tolerance(mesh);
  return merge_nodes(std::move(mesh), tolerance).mesh;
}

/// A plane piece from a corner along two sides.
inline auto plate(const Vector3d& corner, const Vector3d& side_1, const Vector3d& side_2) {
  return [=](double s, double t) { return Vector3d(corner + s * side_1 + t * side_2); };
}

/// The six faces of the cube from -1/2 to 1/2, moved by a map of space. The normals point outwards.
template <class Move>
SpaceMesh cube(mesh::Shape shape, int cells, int order, const Move& move) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5})
      add_grid(
          {cells, cells, order},
          [&](double s, double t) {
            Vector3d x;
            x[axis] = side;
            x[(axis + 1) % 3] = side > 0 ? s - 0.5 : t - 0.5;
            x[(axis + 2) % 3] = side > 0 ? t - 0.5 : s - 0.5;
            return Vector3d(move(x));
          },
          mesh);
  return glued(std::move(mesh));
}
inline SpaceMesh cube(mesh::Shape shape, int cells, int order = 1) {
  return cube(shape, cells, order, [](const Vector3d& x) { return x; });
}
/// The unit sphere, with cells of nearly equal angles.
inline SpaceMesh sphere(mesh::Shape shape, int cells, int order) {
  return cube(shape, cells, order, [](const Vector3d& x) { return (pi / 2 * x).array().tan().matrix().normalized(); });
}

/// The torus with radii 3 and 1, round the z axis.
inline SpaceMesh torus(mesh::Shape shape, const Grid& grid) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  add_grid(
      grid,
      [](double s, double t) {
        const double r = 3 + std::cos(2 * pi * t);
        return Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), std::sin(2 * pi * t));
      },
      mesh);
  return glued(std::move(mesh));
}

/// A tube of radius 1 and length 2 round the z axis.
inline SpaceMesh tube(mesh::Shape shape, const Grid& grid) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  add_grid(
      grid, [](double s, double t) { return Vector3d(std::cos(2 * pi * s), std::sin(2 * pi * s), 2 * t); }, mesh);
  return glued(std::move(mesh));
}

/// A strip of width 1 round a circle of radius 3, with a number of half turns.
inline SpaceMesh twisted_strip(mesh::Shape shape, const Grid& grid, int half_turns) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  add_grid(
      grid,
      [&](double s, double t) {
        const double r = 3 + (t - 0.5) * std::cos(half_turns * pi * s);
        return Vector3d(r * std::cos(2 * pi * s), r * std::sin(2 * pi * s), (t - 0.5) * std::sin(half_turns * pi * s));
      },
      mesh);
  return glued(std::move(mesh));
}

/// Plates of 1 x 1 that leave the y axis at the given angles from the x axis.
inline SpaceMesh star(mesh::Shape shape, int cells, int order, const std::vector<double>& angles) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  for (const double a : angles)
    add_grid({cells, cells, order}, plate({0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {0, 1, 0}), mesh);
  return glued(std::move(mesh));
}

/// Turns some cells, by chance.
inline void turn_some(SpaceMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  for (SurfaceCell& cell : mesh.cells)
    if (random() % 2 == 0) cell = turned(mesh.shape, cell);
}

/// The same mesh with nodes and cells in another order, by chance.
inline SpaceMesh shuffled(const SpaceMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::int32_t> p(n);
    for (std::size_t i = 0; i < n; ++i) {
      p[i] = static_cast<std::int32_t>(i);
      std::swap(p[i], p[random() % (i + 1)]);
    }
    return p;
  };
  const auto new_node = permutation(mesh.nodes.size()), new_cell = permutation(mesh.cells.size());
  SpaceMesh other = mesh;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) other.nodes[new_node[n]] = mesh.nodes[n];
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    SurfaceCell& cell = other.cells[new_cell[c]];
    cell = mesh.cells[c];
    for (std::int32_t& n : cell.nodes) n = new_node[n];
  }
  return other;
}

/// Makes two nodes of a mesh one, removes or turns a cell, or changes a node of a cell, by chance.
inline void damage(SpaceMesh& mesh, std::mt19937& random) {
  const auto any_cell = [&]() -> SurfaceCell& { return mesh.cells[random() % mesh.cells.size()]; };
  const auto any_node = [&]() -> std::int32_t& {
    SurfaceCell& cell = any_cell();
    return cell.nodes[random() % cell.nodes.size()];
  };
  const std::int32_t from = any_node(), to = any_node();
  switch (random() % 5) {
    case 0:
      for (SurfaceCell& cell : mesh.cells) std::ranges::replace(cell.nodes, from, to);
      break;
    case 1:
      mesh.cells.erase(mesh.cells.begin() + static_cast<std::ptrdiff_t>(random() % mesh.cells.size()));
      break;
    case 2:
      any_node() = from;
      break;
    case 3:
      any_cell() = turned(mesh.shape, any_cell());
      break;
    default:
      mesh.nodes[from] += 0.3 * (mesh.nodes[to] - mesh.nodes[from]);
  }
}

}  // namespace plastron::topology::space_meshes
