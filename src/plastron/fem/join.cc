#include <plastron/fem/join.hpp>

#include <plastron/fem/basis.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace plastron::fem {

namespace {

using algebra::GlobalIndex, algebra::LocalIndex;
using Eigen::Vector3d;

/// A node on a boundary of a join, as all ranks know it.
struct EdgeNode {
  GlobalIndex node;
  Vector3d place, normal;
};

constexpr std::size_t packed_size = 7;

int boundary_index(const CoarseMesh& coarse, const std::string& name) {
  const auto found = std::ranges::find(coarse.boundaries, name);
  if (found == coarse.boundaries.end())
    throw DomainError(fmt::format("an edge of a join is not there: there is no boundary \"{}\"; the mesh has: {}", name,
                                  fmt::join(coarse.boundaries, ", ")));
  return static_cast<int>(found - coarse.boundaries.begin());
}

/// The nodes on a boundary, ascending, the same on every rank (collective).
std::vector<EdgeNode> nodes_on(const Space& space, const Surface& surface, int boundary) {
  const auto line = gauss_lobatto(space.degree + 1).points;
  std::map<GlobalIndex, std::array<Vector3d, 2>> mine;
  for (const BoundarySide& side : space.sides) {
    if (side.boundary != boundary || side.cell >= space.owned_cells) continue;
    std::vector<Vector2d> xi;
    xi.reserve(line.size());
    for (const double t : line) xi.push_back(side_point(space.shape(), side.side, t));
    std::vector<geometry::SurfaceJet> jets(xi.size());
    surface.jets(space.cells[side.cell], xi, jets, false);
    const auto on_side = side_nodes(space.shape(), space.degree, side.side);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const LocalIndex node = space.nodes(side.cell)[static_cast<std::size_t>(on_side[i])];
      mine[space.layout->global(node)] = {jets[i].value, geometry::unit_normal(jets[i])};
    }
  }
  std::vector<double> packed;
  for (const auto& [node, at] : mine) {
    packed.push_back(static_cast<double>(node));
    for (const Vector3d& v : at) packed.insert(packed.end(), v.begin(), v.end());
  }
  const auto all = algebra::gather_over_ranks(packed, space.layout->comm);
  std::map<GlobalIndex, EdgeNode> nodes;
  for (std::size_t i = 0; i < all.size(); i += packed_size) {
    const auto node = static_cast<GlobalIndex>(all[i]);
    nodes.emplace(node, EdgeNode{node, {all[i + 1], all[i + 2], all[i + 3]}, {all[i + 4], all[i + 5], all[i + 6]}});
  }
  std::vector<EdgeNode> list;
  list.reserve(nodes.size());
  for (const auto& [node, at] : nodes) list.push_back(at);
  return list;
}

double length_of(const std::vector<EdgeNode>& nodes) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const EdgeNode& node : nodes) {
    low = low.cwiseMin(node.place);
    high = high.cwiseMax(node.place);
  }
  return (high - low).norm();
}

/// Classes of nodes that are one; the representative is the smallest number.
class Classes {
 public:
  GlobalIndex representative(GlobalIndex node) const {
    for (auto at = parent_.find(node); at != parent_.end(); at = parent_.find(node)) node = at->second;
    return node;
  }
  void unite(GlobalIndex a, GlobalIndex b) {
    a = representative(a);
    b = representative(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }
  bool is_tied(GlobalIndex node) const { return parent_.contains(node); }

 private:
  std::map<GlobalIndex, GlobalIndex> parent_;
};

void unite_partners(const Join& join, const std::array<std::vector<EdgeNode>, 2>& sides, Classes& classes) {
  constexpr double same_place = 1e-8, same_normal = 1e-6;
  const double length = length_of(sides[0]);
  const auto& [first, second] = join.boundaries;
  if (sides[0].size() != sides[1].size())
    throw DomainError(fmt::format(
        "the edges \"{}\" and \"{}\" cannot be joined: they have {} and {} nodes; divide both into the same cells",
        first, second, sides[0].size(), sides[1].size()));
  for (const EdgeNode& node : sides[1]) {
    const auto distance = [&](const EdgeNode& other) { return (other.place - node.place).norm(); };
    const EdgeNode& partner = *std::ranges::min_element(sides[0], {}, distance);
    if (!(distance(partner) <= same_place * length))
      throw DomainError(
          fmt::format("the edges \"{}\" and \"{}\" cannot be joined: the point ({:.6g}, {:.6g}, {:.6g}) of \"{}\" is "
                      "{:.3g} m from the nearest node of \"{}\"; joined edges lie on each other in space and are "
                      "divided alike",
                      first, second, node.place[0], node.place[1], node.place[2], second, distance(partner), first));
    if (!((partner.normal - node.normal).norm() <= same_normal))
      throw DomainError(
          fmt::format("the edges \"{}\" and \"{}\" cannot be joined: at ({:.6g}, {:.6g}, {:.6g}) a_3 is ({:.3g}, "
                      "{:.3g}, {:.3g}) on one and "
                      "({:.3g}, {:.3g}, {:.3g}) on the other; shells that meet at an angle are not joined by this "
                      "version, and where "
                      "a_3 points the other way, exchange x and y in one of the charts",
                      first, second, node.place[0], node.place[1], node.place[2], partner.normal[0], partner.normal[1],
                      partner.normal[2], node.normal[0], node.normal[1], node.normal[2]));
    classes.unite(node.node, partner.node);
  }
}

/// The space with further ghosts; the owned nodes keep their numbers.
void widen(Space& space, const std::set<GlobalIndex>& wanted) {
  const algebra::Layout& before = *space.layout;
  auto after = std::make_shared<algebra::Layout>(before);
  for (const GlobalIndex node : wanted)
    if (node < before.first || node >= before.first + before.owned) after->ghosts.push_back(node);
  std::ranges::sort(after->ghosts);
  after->ghosts.erase(std::unique(after->ghosts.begin(), after->ghosts.end()), after->ghosts.end());
  for (LocalIndex& node : space.connectivity.nodes) {
    if (node < before.owned) continue;
    const auto found = std::ranges::lower_bound(after->ghosts, before.global(node));
    node = after->owned + static_cast<LocalIndex>(found - after->ghosts.begin());
  }
  space.layout = std::move(after);
}

LocalIndex local_in(const algebra::Layout& layout, GlobalIndex node) {
  if (node >= layout.first && node < layout.first + layout.owned) return static_cast<LocalIndex>(node - layout.first);
  return layout.owned + static_cast<LocalIndex>(std::ranges::lower_bound(layout.ghosts, node) - layout.ghosts.begin());
}

}  // namespace

std::shared_ptr<const Space> joined(std::shared_ptr<const Space> space, const Surface& surface,
                                    const std::vector<Join>& joins) {
  if (joins.empty()) return space;
  Classes classes;
  std::set<int> boundaries;
  for (const Join& join : joins) {
    std::array<std::vector<EdgeNode>, 2> sides;
    for (std::size_t k = 0; k < 2; ++k) {
      const int boundary = boundary_index(*space->coarse, join.boundaries[k]);
      boundaries.insert(boundary);
      sides[k] = nodes_on(*space, surface, boundary);
    }
    unite_partners(join, sides, classes);
  }
  auto result = std::make_shared<Space>(*space);
  std::set<GlobalIndex> masters;
  for (LocalIndex i = 0; i < space->layout->local_size(); ++i)
    if (const GlobalIndex node = space->layout->global(i); classes.is_tied(node))
      masters.insert(classes.representative(node));
  widen(*result, masters);
  for (LocalIndex i = 0; i < result->layout->local_size(); ++i)
    if (const GlobalIndex node = result->layout->global(i); classes.is_tied(node))
      result->ties.push_back({i, {{local_in(*result->layout, classes.representative(node)), 1.0}}});
  result->has_ties = true;
  // The shell does not end there.
  for (BoundarySide& side : result->sides)
    if (boundaries.contains(side.boundary)) side.is_inner = true;
  return result;
}

}  // namespace plastron::fem
