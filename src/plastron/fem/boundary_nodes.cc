#include <plastron/fem/boundary_nodes.hpp>

#include <plastron/algebra/gathered.hpp>
#include <plastron/geometry/frame.hpp>
#include <plastron/mesh/basis.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace plastron::fem {

using algebra::GlobalIndex, algebra::LocalIndex;

int boundary_index(const mesh::CoarseMesh& coarse, const std::string& name, const char* what) {
  const auto found = std::ranges::find(coarse.boundaries, name);
  if (found == coarse.boundaries.end())
    throw mesh::DomainError(fmt::format("{} is not there: there is no boundary \"{}\"; the mesh has: {}", what, name,
                                        fmt::join(coarse.boundaries, ", ")));
  return static_cast<int>(found - coarse.boundaries.begin());
}

namespace {

/// Returns the nodes of sides of owned cells by the number of their boundary (collective).
std::map<int, std::vector<BoundaryNode>> nodes_of(const Space& space, const Surface& surface,
                                                  const std::vector<BoundarySide>& sides) {
  const auto line = mesh::gauss_lobatto(space.degree + 1).points;
  std::map<std::pair<int, GlobalIndex>, BoundaryNode> mine, all;
  for (const BoundarySide& side : sides) {
    if (side.cell >= space.owned_cells) continue;
    std::vector<Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(mesh::side_point(space.shape(), side.side, t));
    std::vector<geometry::Frame> frames(xi.size());
    surface.frames(space.cells[side.cell], xi, frames, false);
    const Vector2d tangent = mesh::side_tangent(space.shape(), side.side);
    const auto on_side = mesh::side_nodes(space.shape(), space.degree, side.side);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const GlobalIndex node = space.layout->global(space.nodes(side.cell)[on_side[i]]);
      mine[{side.boundary, node}] = {node, frames[i].phi, frames[i].a3,
                                     geometry::along(frames[i], tangent).normalized()};
    }
  }
  std::vector<std::pair<int, BoundaryNode>> items;
  items.reserve(mine.size());
  for (const auto& [key, node] : mine) items.emplace_back(key.first, node);
  for (const auto& [boundary, node] : algebra::gathered(items, space.layout->comm))
    all.emplace(std::pair(boundary, node.node), node);
  std::map<int, std::vector<BoundaryNode>> lists;
  for (const auto& [key, node] : all) lists[key.first].push_back(node);
  return lists;
}

}  // namespace

std::vector<BoundaryNode> nodes_on(const Space& space, const Surface& surface, int boundary) {
  std::vector<BoundarySide> sides;
  std::ranges::copy_if(space.sides, std::back_inserter(sides),
                       [&](const BoundarySide& side) { return side.boundary == boundary; });
  return nodes_of(space, surface, sides)[boundary];
}

std::vector<std::vector<BoundaryNode>> fold_nodes(const Space& space, const Surface& surface) {
  std::vector<std::vector<BoundaryNode>> all(2 * space.coarse->folds.size());
  for (auto& [edge, nodes] : nodes_of(space, surface, space.fold_sides))
    all[static_cast<std::size_t>(edge)] = std::move(nodes);
  return all;
}

void widen(Space& space, const std::set<GlobalIndex>& wanted) {
  const algebra::Layout& before = *space.layout;
  algebra::Distribution wide = before;
  wide.add_ghosts({wanted.begin(), wanted.end()});
  auto after = std::make_shared<const algebra::Layout>(std::move(wide));
  const auto renumber = [&](LocalIndex& node) { node = after->local(before.global(node)); };
  std::ranges::for_each(space.connectivity.nodes, renumber);
  for (ConstraintMap* map : {&space.continuity, &space.kinks, &space.constraints}) map->renumber(before, *after);
  space.layout = std::move(after);
}

}  // namespace plastron::fem
