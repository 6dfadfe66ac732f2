#include <plastron/fem/boundary_nodes.hpp>

#include <plastron/fem/basis.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

namespace plastron::fem {

using algebra::GlobalIndex, algebra::LocalIndex;
using Eigen::Vector3d;

namespace {

/// Size of a packed node: number, place, normal, tangent.
constexpr std::size_t boundary_node_size = 10;

}  // namespace

int boundary_index(const CoarseMesh& coarse, const std::string& name, const char* what) {
  const auto found = std::ranges::find(coarse.boundaries, name);
  if (found == coarse.boundaries.end())
    throw DomainError(fmt::format("{} is not there: there is no boundary \"{}\"; the mesh has: {}", what, name,
                                  fmt::join(coarse.boundaries, ", ")));
  return static_cast<int>(found - coarse.boundaries.begin());
}

std::vector<BoundaryNode> nodes_on(const Space& space, const Surface& surface, int boundary) {
  const auto line = gauss_lobatto(space.degree + 1).points;
  std::map<GlobalIndex, std::array<Vector3d, 3>> mine;
  for (const BoundarySide& side : space.sides) {
    if (side.boundary != boundary || side.cell >= space.owned_cells) continue;
    std::vector<Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(side_point(space.shape(), side.side, t));
    std::vector<geometry::SurfaceJet> jets(xi.size());
    surface.jets(space.cells[side.cell], xi, jets, false);
    const Vector2d tangent = side_tangent(space.shape(), side.side);
    const auto on_side = side_nodes(space.shape(), space.degree, side.side);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const LocalIndex node = space.nodes(side.cell)[on_side[i]];
      mine[space.layout->global(node)] = {jets[i].value, geometry::unit_normal(jets[i]),
                                          (tangent[0] * jets[i].d[0] + tangent[1] * jets[i].d[1]).normalized()};
    }
  }
  std::vector<double> packed;
  for (const auto& [node, at] : mine) {
    packed.push_back(static_cast<double>(node));
    for (const Vector3d& v : at) packed.insert(packed.end(), v.begin(), v.end());
  }
  const auto all = algebra::gather_over_ranks(packed, space.layout->comm);
  std::map<GlobalIndex, BoundaryNode> nodes;
  for (std::size_t i = 0; i < all.size(); i += boundary_node_size) {
    const auto node = static_cast<GlobalIndex>(all[i]);
    const auto vector = [&](std::size_t at) { return Vector3d(all[i + at], all[i + at + 1], all[i + at + 2]); };
    nodes.emplace(node, BoundaryNode{node, vector(1), vector(4), vector(7)});
  }
  std::vector<BoundaryNode> list;
  list.reserve(nodes.size());
  for (const auto& [node, at] : nodes) list.push_back(at);
  return list;
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
