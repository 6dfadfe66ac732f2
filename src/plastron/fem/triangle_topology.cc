#include <plastron/fem/triangle_topology.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

namespace plastron::fem {

namespace {

std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Returns the half of an edge at one of its vertices: edge e becomes 2e (at its first vertex) and 2e + 1.
int half(const TriangleTopology& mesh, int edge, int vertex) {
  return 2 * edge + (mesh.edges[static_cast<std::size_t>(edge)][0] == vertex ? 0 : 1);
}

void refine_cell(const TriangleTopology& mesh, std::size_t c, TriangleTopology& fine) {
  const Cell& cell = mesh.cells[c];
  const auto& v = mesh.vertices[c];
  const auto& e = mesh.sides[c];
  std::array<int, 3> middle{}, inner{};  // inner edge k cuts off corner k
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = mesh.vertex_count + e[k];
    inner[k] = static_cast<int>(2 * mesh.edges.size() + 3 * c + k);
  }
  for (std::size_t k = 0; k < 3; ++k) fine.edges[static_cast<std::size_t>(inner[k])] = {middle[k], middle[(k + 2) % 3]};
  for (int k = 0; k < 4; ++k) {
    const Cell child = child_cell(k);
    fine.cells.push_back({cell.coarse, cell.corner + cell.size * child.corner, cell.size * child.size});
  }
  fine.vertices.push_back({v[0], middle[0], middle[2]});
  fine.vertices.push_back({middle[0], v[1], middle[1]});
  fine.vertices.push_back({middle[2], middle[1], v[2]});
  fine.vertices.push_back({middle[1], middle[2], middle[0]});
  fine.sides.push_back({half(mesh, e[0], v[0]), inner[0], half(mesh, e[2], v[0])});
  fine.sides.push_back({half(mesh, e[0], v[1]), half(mesh, e[1], v[1]), inner[1]});
  fine.sides.push_back({inner[2], half(mesh, e[1], v[2]), half(mesh, e[2], v[2])});
  fine.sides.push_back({inner[2], inner[0], inner[1]});
}

}  // namespace

Cell child_cell(int child) {
  if (child == 3) return {.corner = {0.5, 0.5}, .size = -0.5};
  return {.corner = corner(Shape::triangle, child) / 2, .size = 0.5};
}

TriangleTopology coarse_topology(const CoarseMesh& mesh) {
  TriangleTopology topology{.vertex_count = static_cast<int>(mesh.vertices.size())};
  std::map<std::array<int, 2>, int> edge_of;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto& v = mesh.cells[c].vertices;
    topology.cells.push_back({.coarse = static_cast<int>(c)});
    topology.vertices.push_back({v[0], v[1], v[2]});
    auto& sides = topology.sides.emplace_back();
    for (std::size_t s = 0; s < 3; ++s) {
      const auto ends = sorted(v[s], v[(s + 1) % 3]);
      const auto [found, is_new] = edge_of.emplace(ends, static_cast<int>(topology.edges.size()));
      if (is_new) topology.edges.push_back(ends);
      sides[s] = found->second;
    }
  }
  return topology;
}

void check_refinable(std::int64_t vertices, std::int64_t edges, std::int64_t cells) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  const std::int64_t refined_edges = 2 * edges + 3 * cells;
  if (refined_edges <= most && vertices + edges <= most) return;
  throw DomainError(
      fmt::format("a mesh of {} triangles, refined, has {} edges, more than the {} that can be numbered: take fewer "
                  "refinements, or quadrilaterals",
                  cells, refined_edges, most));
}

TriangleTopology refined(const TriangleTopology& mesh) {
  check_refinable(mesh.vertex_count, static_cast<std::int64_t>(mesh.edges.size()),
                  static_cast<std::int64_t>(mesh.cells.size()));
  TriangleTopology fine{.vertex_count = mesh.vertex_count + static_cast<int>(mesh.edges.size())};
  fine.edges.resize(2 * mesh.edges.size() + 3 * mesh.cells.size());
  fine.cells.reserve(4 * mesh.cells.size());
  fine.vertices.reserve(4 * mesh.cells.size());
  fine.sides.reserve(4 * mesh.cells.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const int middle = mesh.vertex_count + static_cast<int>(e);
    for (std::size_t k = 0; k < 2; ++k) fine.edges[2 * e + k] = {mesh.edges[e][k], middle};
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) refine_cell(mesh, c, fine);
  return fine;
}

}  // namespace plastron::fem
