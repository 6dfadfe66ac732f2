#include <plastron/topology/space_mesh.hpp>

#include <plastron/topology/disjoint_sets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plastron::topology {

namespace {

/// Nodes of sides that no other cell has, or that another cell has with different nodes inside. Ascending.
std::vector<std::int32_t> open_nodes(const SpaceMesh& mesh) {
  const std::vector<mesh::MeshEdge> sides = edges_of(mesh);
  std::vector<std::int32_t> open;
  const auto nodes_on = [&](const mesh::MeshEdge& side) {
    std::vector<std::int32_t> nodes;
    for (const int place : ascending_places(mesh, side)) nodes.push_back(mesh.cells[side.cell].nodes[place]);
    return nodes;
  };
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    bool is_open = false;
    for (; end < sides.size() && sides[end].ends == sides[i].ends; ++end)
      is_open = is_open || nodes_on(sides[end]) != nodes_on(sides[i]);
    is_open = is_open || end == i + 1;
    for (; i < end; ++i)
      if (is_open) std::ranges::copy(nodes_on(sides[i]), std::back_inserter(open));
  }
  std::ranges::sort(open);
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return open;
}

/// Calls `visit` for all pairs of an open node and any node of a cell within the distance. Nodes are swept along a
/// direction in which few nodes of usual meshes have equal places.
template <class Visit>
void visit_near(const SpaceMesh& mesh, double distance, const Visit& visit) {
  std::vector<char> is_open(mesh.nodes.size(), false), is_used = is_open;
  for (const std::int32_t n : open_nodes(mesh)) is_open[n] = true;
  for (const SurfaceCell& cell : mesh.cells)
    for (const std::int32_t n : cell.nodes) is_used[n] = true;
  const Vector3d direction = Vector3d(0.5772156649, 0.6180339887, 0.5337494321).normalized();
  std::vector<std::pair<double, std::size_t>> sorted;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (is_used[n]) sorted.emplace_back(direction.dot(mesh.nodes[n]), n);
  std::ranges::sort(sorted);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const auto [place, a] = sorted[i];
    if (!is_open[a]) continue;
    const auto from = std::ranges::lower_bound(sorted, place - distance, {}, &std::pair<double, std::size_t>::first);
    for (auto at = from; at != sorted.end() && at->first <= place + distance; ++at)
      if (at->second != a && (mesh.nodes[a] - mesh.nodes[at->second]).norm() <= distance) visit(a, at->second);
  }
}

void check_nodes_differ(const SpaceMesh& before, const MergedMesh& after, double tolerance) {
  for (std::size_t c = 0; c < before.cells.size(); ++c) {
    std::vector<std::pair<std::int32_t, std::int32_t>> numbers;
    for (const std::int32_t n : before.cells[c].nodes) numbers.emplace_back(after.new_number[n], n);
    std::ranges::sort(numbers);
    for (std::size_t i = 1; i < numbers.size(); ++i)
      if (numbers[i].first == numbers[i - 1].first && numbers[i].second != numbers[i - 1].second)
        throw SurfaceError(
            SurfaceError::About::cells,
            fmt::format(
                "{} has two nodes at {} that are nearer to each other than the tolerance {:.6g} and would be merged; "
                "make the tolerance smaller than all distances between nodes of an element",
                place_of(before.cells[c]), place_of(before.nodes[numbers[i].second]), tolerance));
  }
}

}  // namespace

std::string place_of(const SurfaceCell& cell) {
  return cell.line > 0 ? fmt::format("element {} (line {})", cell.tag, cell.line) : fmt::format("element {}", cell.tag);
}

std::string place_of(const Vector3d& point) {
  // Rounding of a coordinate is no place.
  const double negligible = 1e-12 * point.norm();
  const auto cleared = [&](double c) { return std::abs(c) <= negligible ? 0 : c; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", cleared(point[0]), cleared(point[1]), cleared(point[2]));
}

std::array<int, 4> corner_nodes(mesh::Shape shape, const SurfaceCell& cell) {
  const auto& n = cell.nodes;
  const auto order = static_cast<std::size_t>(cell.order);
  if (shape == mesh::Shape::triangle) return {n[0], n[order], n.back(), -1};
  return {n[0], n[order], n[n.size() - 1 - order], n.back()};
}

SurfaceCell turned(mesh::Shape shape, const SurfaceCell& cell) {
  SurfaceCell other = cell;
  const int n = cell.order;
  // Row j of the triangle follows rows of n + 1, n, ... nodes.
  const auto index = [&](int i, int j) {
    return shape == mesh::Shape::triangle ? j * (n + 1) - j * (j - 1) / 2 + i : j * (n + 1) + i;
  };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (shape == mesh::Shape::triangle ? n - j : n); ++i) {
      other.nodes[index(j, i)] = cell.nodes[index(i, j)];
      if (!cell.normals.empty()) other.normals[index(j, i)] = -cell.normals[index(i, j)];
    }
  return other;
}

std::vector<mesh::MeshEdge> edges_of(const SpaceMesh& mesh) {
  std::vector<mesh::MeshEdge> sides;
  sides.reserve(mesh.cells.size() * static_cast<std::size_t>(mesh::corner_count(mesh.shape)));
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto corners = corner_nodes(mesh.shape, mesh.cells[c]);
    for (int side = 0; side < mesh::corner_count(mesh.shape); ++side) {
      const auto [from, to] = mesh::anticlockwise_corners(mesh.shape, side);
      const int a = corners[from], b = corners[to];
      sides.push_back({{std::min(a, b), std::max(a, b)}, c, side, a < b});
    }
  }
  std::ranges::stable_sort(sides, {}, &mesh::MeshEdge::ends);
  return sides;
}

std::vector<int> ascending_places(const SpaceMesh& mesh, const mesh::MeshEdge& side) {
  const SurfaceCell& cell = mesh.cells[side.cell];
  std::vector<int> places = mesh::side_nodes(mesh.shape, cell.order, side.side);
  if (cell.nodes[places.front()] > cell.nodes[places.back()]) std::ranges::reverse(places);
  return places;
}

double diagonal(const SpaceMesh& mesh) {
  Vector3d low = Vector3d::Constant(HUGE_VAL), high = -low;
  for (const SurfaceCell& cell : mesh.cells)
    for (const std::int32_t n : cell.nodes) {
      low = low.cwiseMin(mesh.nodes[n]);
      high = high.cwiseMax(mesh.nodes[n]);
    }
  return mesh.cells.empty() ? 0 : (high - low).norm();
}

double merge_tolerance(const SpaceMesh& mesh) {
  constexpr double negligible = 1e-9;
  return negligible * diagonal(mesh);
}

MergedMesh merge_nodes(SpaceMesh mesh, double tolerance) {
  DisjointSets sets(mesh.nodes.size());
  visit_near(mesh, tolerance, [&](std::size_t a, std::size_t b) { sets.unite(a, b); });
  MergedMesh result;
  result.mesh.shape = mesh.shape;
  const bool has_normals = !mesh.normals.empty();
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const std::size_t kept = sets.of(n);
    if (kept == n) {
      result.new_number.push_back(static_cast<std::int32_t>(result.mesh.nodes.size()));
      result.mesh.nodes.push_back(mesh.nodes[n]);
      if (has_normals) result.mesh.normals.push_back(mesh.normals[n]);
    } else {
      const std::int32_t number = result.new_number[kept];
      result.new_number.push_back(number);
      ++result.merged;
      if (has_normals && !result.mesh.normals[number]) result.mesh.normals[number] = mesh.normals[n];
    }
  }
  if (result.merged > 0) check_nodes_differ(mesh, result, tolerance);
  result.mesh.cells = std::move(mesh.cells);
  for (SurfaceCell& cell : result.mesh.cells)
    for (std::int32_t& n : cell.nodes) n = result.new_number[n];
  return result;
}

}  // namespace plastron::topology
