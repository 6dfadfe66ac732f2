#include <plastron/topology/surface_topology.hpp>

#include <plastron/topology/disjoint_sets.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>

namespace plastron::topology {

namespace {

/// Positions on the lattice of the nodes of each side, by order.
class SidePlaces {
 public:
  explicit SidePlaces(mesh::Shape shape) : shape_(shape) {}

  /// From the lower end to the higher one.
  std::vector<int> ascending(const SurfaceCell& cell, int side) {
    std::vector<int> places = of(cell.order)[side];
    if (cell.nodes[places.front()] > cell.nodes[places.back()]) std::ranges::reverse(places);
    return places;
  }

 private:
  const std::array<std::vector<int>, 4>& of(int order) {
    const auto [found, is_new] = places_.try_emplace(order);
    if (is_new)
      for (int side = 0; side < mesh::corner_count(shape_); ++side)
        found->second[side] = mesh::side_nodes(shape_, order, side);
    return found->second;
  }

  mesh::Shape shape_;
  std::map<int, std::array<std::vector<int>, 4>> places_;
};

double default_smooth_angle(const SpaceMesh& mesh) {
  // Where faces meet smoothly, CAD programs are right to 0.1 degrees or so; means of normals of cells are not.
  if (std::ranges::none_of(mesh.cells, [](const SurfaceCell& cell) { return cell.normals.empty(); }))
    return std::numbers::pi / 180;
  const bool has_facets = std::ranges::any_of(mesh.cells, [](const SurfaceCell& cell) { return cell.order == 1; });
  return (has_facets ? 30 : 10) * std::numbers::pi / 180;
}

class TopologyBuilder {
 public:
  TopologyBuilder(SpaceMesh mesh, const SurfaceOptions& options) : options_(options), places_(mesh.shape) {
    t_.mesh = std::move(mesh);
    t_.smooth_angle = options.smooth_angle.value_or(default_smooth_angle(t_.mesh));
  }

  SurfaceTopology build() {
    check_cells();
    find_edges();
    check_shared_nodes();
    orient();
    const LatticeNormals normals = lattice_normals(t_.mesh);
    for (SurfaceEdge& edge : t_.edges) classify(edge, normals);
    find_edges_near_limit();
    DisjointSets copies = fans(normals.normal.size(), normals.first);
    number_copies(copies, normals.first);
    number_vertices();
    number_sheets();
    number_parts();
    t_.largest_director_angle =
        set_directors(t_.mesh, normals, t_.cell_director_nodes, ends_of_surface(), t_.director_nodes);
    return std::move(t_);
  }

 private:
  /// Whether a smooth sheet ends at each side of each cell.
  std::vector<bool> ends_of_surface() const {
    const auto corners = static_cast<std::size_t>(mesh::corner_count(t_.mesh.shape));
    std::vector<bool> ends(t_.mesh.cells.size() * corners, false);
    for (const SurfaceEdge& edge : t_.edges) {
      if (edge.kind == EdgeKind::smooth || edge.is_lone_fold) continue;
      for (const mesh::MeshEdge& side : sides(edge))
        ends[side.cell * corners + static_cast<std::size_t>(side.side)] = true;
    }
    return ends;
  }

  [[noreturn]] static void refuse(const std::string& what) { throw SurfaceError(SurfaceError::About::cells, what); }
  const SurfaceCell& cell(std::size_t c) const { return t_.mesh.cells[c]; }
  std::string name(std::size_t c) const { return place_of(cell(c)); }
  std::string place(std::int32_t node) const { return place_of(t_.mesh.nodes[node]); }
  std::span<const mesh::MeshEdge> sides(const SurfaceEdge& edge) const {
    return std::span(t_.sides).subspan(edge.first_side, edge.side_count);
  }

  /// The nodes of a cell must differ, and two cells must not have the same corners.
  void check_cells() const {
    assert(t_.mesh.normals.empty() || t_.mesh.normals.size() == t_.mesh.nodes.size());
    std::vector<std::pair<std::array<int, 4>, std::size_t>> corners;
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c) {
      assert(static_cast<int>(cell(c).nodes.size()) == mesh::nodes_per_cell(t_.mesh.shape, cell(c).order));
      auto own = corner_nodes(t_.mesh.shape, cell(c));
      std::ranges::sort(own);
      if (const auto twice = std::ranges::adjacent_find(own); twice != own.end())
        refuse(
            fmt::format("{} closes on itself: the node at {} is its corner twice; divide it, so that the surface has "
                        "three elements or more round there, and do not use collapsed elements",
                        name(c), place(*twice)));
      std::vector<std::int32_t> nodes = cell(c).nodes;
      std::ranges::sort(nodes);
      if (const auto twice = std::ranges::adjacent_find(nodes); twice != nodes.end())
        refuse(fmt::format("{} has the node at {} twice; the nodes of an element must differ", name(c), place(*twice)));
      corners.emplace_back(own, c);
    }
    std::ranges::sort(corners);
    for (std::size_t i = 1; i < corners.size(); ++i)
      if (corners[i].first == corners[i - 1].first) refuse_same_corners(corners[i - 1].second, corners[i].second);
  }

  [[noreturn]] void refuse_same_corners(std::size_t a, std::size_t b) const {
    std::vector<std::int32_t> nodes[2] = {cell(a).nodes, cell(b).nodes};
    for (auto& n : nodes) std::ranges::sort(n);
    const std::string where = place(cell(a).nodes.front());
    if (nodes[0] == nodes[1])
      refuse(fmt::format("{} and {} have the same nodes, first {}; remove one of them", name(a), name(b), where));
    refuse(
        fmt::format("{} and {} have the same corners, first {}, and different nodes between them; divide them, so that "
                    "a tube has three elements or more round its axis",
                    name(a), name(b), where));
  }

  void find_edges() {
    t_.sides = edges_of(t_.mesh);
    t_.edges.clear();
    for (std::size_t i = 0, end = 0; i < t_.sides.size(); i = end) {
      for (end = i + 1; end < t_.sides.size() && t_.sides[end].ends == t_.sides[i].ends;) ++end;
      t_.edges.push_back({.ends = t_.sides[i].ends, .first_side = i, .side_count = end - i});
    }
  }

  /// Every node is a corner of all its cells, or inside one edge of all its cells, or inside one cell.
  void check_shared_nodes() {
    for (const SurfaceEdge& edge : t_.edges)
      for (const mesh::MeshEdge& side : sides(edge).subspan(1)) check_same_nodes(sides(edge)[0], side);
    struct Owner {
      enum Kind { nothing, corner, edge, cell } kind = nothing;
      std::size_t index = 0;  ///< of the edge or cell
      std::size_t first_cell = 0;
      bool operator==(const Owner& o) const { return kind == o.kind && index == o.index; }
    };
    std::vector<Owner> owners(t_.mesh.nodes.size());
    const auto set = [&](std::int32_t node, const Owner& owner) {
      if (owners[node].kind == Owner::nothing) owners[node] = owner;
      if (!(owners[node] == owner))
        refuse(
            fmt::format("{} and {} share the node at {}, which is a corner of only one of them or lies on different "
                        "sides; neighbours must share whole sides with all their nodes",
                        name(owners[node].first_cell), name(owner.first_cell), place(node)));
    };
    std::vector<std::vector<bool>> is_on_side;
    for (const SurfaceCell& c : t_.mesh.cells) is_on_side.emplace_back(c.nodes.size());
    for (std::size_t e = 0; e < t_.edges.size(); ++e)
      for (const mesh::MeshEdge& side : sides(t_.edges[e])) {
        const std::vector<int> on_side = places_.ascending(cell(side.cell), side.side);
        for (std::size_t i = 0; i < on_side.size(); ++i) {
          const bool is_end = i == 0 || i + 1 == on_side.size();
          set(cell(side.cell).nodes[on_side[i]],
              is_end ? Owner{Owner::corner, 0, side.cell} : Owner{Owner::edge, e, side.cell});
          is_on_side[side.cell][on_side[i]] = true;
        }
      }
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      for (std::size_t n = 0; n < cell(c).nodes.size(); ++n)
        if (!is_on_side[c][n]) set(cell(c).nodes[n], {Owner::cell, c, c});
  }

  void check_same_nodes(const mesh::MeshEdge& a, const mesh::MeshEdge& b) {
    const std::vector<int> first = places_.ascending(cell(a.cell), a.side),
                           other = places_.ascending(cell(b.cell), b.side);
    const auto same = [&](int i, int j) { return cell(a.cell).nodes[i] == cell(b.cell).nodes[j]; };
    if (!std::ranges::equal(first, other, same))
      refuse(fmt::format(
          "the sides of {} and {} between the same corners, {} and {}, have different nodes: they are curved "
          "differently; give both elements the same order and the same nodes there",
          name(a.cell), name(b.cell), place(a.ends[0]), place(a.ends[1])));
  }

  void orient() {
    Orientation orientation = find_orientation(t_.mesh, t_.sides, t_.edges, options_.upper);
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      if (orientation.is_turned[c]) t_.mesh.cells[c] = turned(t_.mesh.shape, cell(c));
    t_.is_turned = std::move(orientation.is_turned);
    t_.component = std::move(orientation.component);
    t_.components = std::move(orientation.components);
    find_edges();
  }

  void classify(SurfaceEdge& edge, const LatticeNormals& normals) {
    constexpr double rounding = 1e-6;  // facets of equal angles may all lie at the limit
    const auto same = sides(edge);
    for (std::size_t i = 0; i < same.size(); ++i)
      for (std::size_t j = i + 1; j < same.size(); ++j)
        edge.angle = std::max(edge.angle, angle_of(same[i], same[j], normals));
    if (same.size() == 1)
      edge.kind = EdgeKind::border;
    else if (same.size() > 2)
      edge.kind = EdgeKind::branch;
    else
      edge.kind = options_.folds.contains(edge.ends) || edge.angle > t_.smooth_angle + rounding ? EdgeKind::fold
                                                                                                : EdgeKind::smooth;
  }

  /// The largest angle between the normals of two cells along their common side, if they had the same orientation.
  double angle_of(const mesh::MeshEdge& a, const mesh::MeshEdge& b, const LatticeNormals& normals) {
    constexpr double fold_back_angle = 179 * std::numbers::pi / 180;
    const double sign = a.is_forward != b.is_forward ? 1 : -1;
    const std::vector<int> first = places_.ascending(cell(a.cell), a.side),
                           other = places_.ascending(cell(b.cell), b.side);
    double largest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const double angle = angle_between(normals.at(a.cell, first[i]), sign * normals.at(b.cell, other[i]));
      if (angle > fold_back_angle)
        refuse(fmt::format(
            "{} and {} fold back onto each other at {}: the angle between their normals is {:.4g} degrees, at "
            "most 179 are allowed; remove one of them or open the fold",
            name(a.cell), name(b.cell), place(cell(a.cell).nodes[first[i]]), angle * 180 / std::numbers::pi));
      largest = std::max(largest, angle);
    }
    return largest;
  }

  void find_edges_near_limit() {
    const auto distance = [&](std::size_t e) { return std::abs(std::log(t_.edges[e].angle / t_.smooth_angle)); };
    for (std::size_t e = 0; e < t_.edges.size(); ++e)
      if (t_.edges[e].side_count == 2 && !options_.folds.contains(t_.edges[e].ends) && distance(e) <= std::log(2))
        t_.edges_near_limit.push_back(e);
    std::ranges::stable_sort(t_.edges_near_limit, {}, distance);
  }

  /// Sets of equal copies among the nodes of all cells, cell by cell.
  DisjointSets fans(std::size_t nodes, const std::vector<std::size_t>& first) {
    DisjointSets copies(nodes);
    const auto join = [&](const mesh::MeshEdge& a, const mesh::MeshEdge& b) {
      const auto i = places_.ascending(cell(a.cell), a.side), j = places_.ascending(cell(b.cell), b.side);
      for (std::size_t n = 0; n < i.size(); ++n) copies.unite(first[a.cell] + i[n], first[b.cell] + j[n]);
    };
    for (const SurfaceEdge& edge : t_.edges)
      if (edge.kind == EdgeKind::smooth) join(sides(edge)[0], sides(edge)[1]);
    for (SurfaceEdge& edge : t_.edges)
      if (edge.kind == EdgeKind::fold || edge.kind == EdgeKind::branch) join_uncut(edge, first, copies, join);
    return copies;
  }

  /// Cells whose copies are equal at both ends of a fold or branch cannot be cut along it.
  template <class Join>
  void join_uncut(SurfaceEdge& edge, const std::vector<std::size_t>& first, DisjointSets& copies, const Join& join) {
    std::vector<std::pair<std::array<std::size_t, 2>, std::size_t>> ends;
    const auto same = sides(edge);
    for (std::size_t s = 0; s < same.size(); ++s) {
      const auto places = places_.ascending(cell(same[s].cell), same[s].side);
      const auto copy = [&](int p) { return copies.of(first[same[s].cell] + p); };
      ends.push_back({{copy(places.front()), copy(places.back())}, s});
    }
    std::ranges::sort(ends);
    for (std::size_t i = 1; i < ends.size(); ++i) {
      if (ends[i].first != ends[i - 1].first) continue;
      if (i > 1 && ends[i].first == ends[i - 2].first)
        refuse(
            fmt::format("the edge from {} to {} has {} elements that are connected smoothly round both of its ends; "
                        "divide the elements there",
                        place(edge.ends[0]), place(edge.ends[1]), same.size()));
      join(same[ends[i - 1].second], same[ends[i].second]);
      if (edge.kind == EdgeKind::fold) {
        edge.kind = EdgeKind::smooth;
        edge.is_lone_fold = true;
      }
    }
  }

  void number_copies(DisjointSets& copies, const std::vector<std::size_t>& first) {
    std::vector<std::pair<std::int32_t, std::size_t>> sorted;  // node, representative
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      for (std::size_t n = 0; n < cell(c).nodes.size(); ++n)
        if (copies.of(first[c] + n) == first[c] + n) sorted.emplace_back(cell(c).nodes[n], first[c] + n);
    std::ranges::sort(sorted);
    std::vector<std::int32_t> number(first.empty() ? 0 : first.back() + t_.mesh.cells.back().nodes.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      number[sorted[i].second] = static_cast<std::int32_t>(i);
      t_.director_nodes.push_back({sorted[i].first, Vector3d::Zero()});
    }
    t_.cell_director_nodes.resize(t_.mesh.cells.size());
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      for (std::size_t n = 0; n < cell(c).nodes.size(); ++n)
        t_.cell_director_nodes[c].push_back(number[copies.of(first[c] + n)]);
  }

  void number_vertices() {
    std::vector<std::int32_t> number(t_.director_nodes.size(), -1);
    const auto corners = [&](std::size_t c) {
      SurfaceCell copy{.nodes = t_.cell_director_nodes[c], .order = cell(c).order};
      return corner_nodes(t_.mesh.shape, copy);
    };
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      for (const int d : corners(c))
        if (d >= 0) number[d] = 0;
    for (std::size_t d = 0; d < number.size(); ++d)
      if (number[d] == 0) {
        number[d] = static_cast<std::int32_t>(t_.vertex_director_nodes.size());
        t_.vertex_director_nodes.push_back(static_cast<std::int32_t>(d));
      }
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c) {
      auto& vertices = t_.cell_vertices.emplace_back(corners(c));
      for (int& v : vertices) v = v < 0 ? -1 : number[v];
    }
  }

  /// Numbers sets of cells by their first cells. Returns the number of sets.
  int number_sets(DisjointSets& sets, std::vector<int>& number) const {
    int count = 0;
    number.resize(t_.mesh.cells.size());
    for (std::size_t c = 0; c < number.size(); ++c) {
      const std::size_t first = sets.of(c);
      number[c] = first == c ? count++ : number[first];
    }
    return count;
  }

  void number_sheets() {
    DisjointSets sheets(t_.mesh.cells.size());
    for (const SurfaceEdge& edge : t_.edges)
      if (edge.kind == EdgeKind::smooth) sheets.unite(sides(edge)[0].cell, sides(edge)[1].cell);
    t_.sheet_count = number_sets(sheets, t_.sheet);
  }

  /// Numbers the parts. All cells at a node must be connected through edges at this node.
  void number_parts() {
    DisjointSets parts(t_.mesh.cells.size()), corners(4 * t_.mesh.cells.size());
    const auto corner_at = [&](std::size_t c, int node) {
      const auto nodes = corner_nodes(t_.mesh.shape, cell(c));
      return 4 * c + static_cast<std::size_t>(std::ranges::find(nodes, node) - nodes.begin());
    };
    for (const SurfaceEdge& edge : t_.edges)
      for (const mesh::MeshEdge& side : sides(edge).subspan(1)) {
        const std::size_t first = sides(edge)[0].cell;
        parts.unite(first, side.cell);
        for (const int node : edge.ends) corners.unite(corner_at(first, node), corner_at(side.cell, node));
      }
    std::vector<int> part;
    t_.part_count = number_sets(parts, part);
    std::vector<std::size_t> at_node(t_.mesh.nodes.size(), SIZE_MAX);
    for (std::size_t c = 0; c < t_.mesh.cells.size(); ++c)
      for (const int node : corner_nodes(t_.mesh.shape, cell(c))) {
        if (node < 0) continue;
        const std::size_t corner = corners.of(corner_at(c, node));
        if (at_node[node] == SIZE_MAX) at_node[node] = corner;
        if (at_node[node] != corner)
          refuse(
              fmt::format("the surface touches itself only at a point {}: {} and {} share this node, but no edge at it "
                          "connects them; join them along a whole edge, or give them different nodes there",
                          place(node), name(at_node[node] / 4), name(c)));
      }
  }

  const SurfaceOptions& options_;
  SidePlaces places_;
  SurfaceTopology t_;
};

}  // namespace

SurfaceTopology surface_topology(SpaceMesh mesh, const SurfaceOptions& options) {
  return TopologyBuilder(std::move(mesh), options).build();
}

const SurfaceEdge* find_edge(const SurfaceTopology& topology, std::array<int, 2> ends) {
  std::ranges::sort(ends);
  const auto found = std::ranges::lower_bound(topology.edges, ends, {}, &SurfaceEdge::ends);
  return found != topology.edges.end() && found->ends == ends ? &*found : nullptr;
}

SurfaceSummary summary_of(const SurfaceTopology& topology) {
  SurfaceSummary summary;
  for (const SurfaceEdge& edge : topology.edges) {
    EdgeStatistics& s = summary.edges[static_cast<std::size_t>(edge.kind)];
    s.least_angle = s.number == 0 ? edge.angle : std::min(s.least_angle, edge.angle);
    s.largest_angle = std::max(s.largest_angle, edge.angle);
    ++s.number;
    if (edge.is_lone_fold) ++summary.lone_folds;
  }
  summary.is_closed = true;
  for (const SurfaceComponent& component : topology.components) {
    summary.turned += component.turned;
    summary.area += component.area;
    summary.volume += component.volume;
    summary.is_closed = summary.is_closed && component.is_closed;
  }
  summary.low = Vector3d::Constant(HUGE_VAL);
  summary.high = -summary.low;
  for (const DirectorNode& n : topology.director_nodes) {
    summary.low = summary.low.cwiseMin(topology.mesh.nodes[n.node]);
    summary.high = summary.high.cwiseMax(topology.mesh.nodes[n.node]);
  }
  return summary;
}

}  // namespace plastron::topology
