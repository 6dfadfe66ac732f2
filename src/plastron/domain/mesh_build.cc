// Conversion of a mesh file's data to a coarse mesh.
#include <plastron/domain/mesh_groups.hpp>
#include <plastron/domain/mesh_validity.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

namespace plastron::domain {

namespace {

class Builder {
 public:
  Builder(const MeshData& data, mesh::Shape shape)
      : data_(data), shape_(shape), groups_(data, MeshGroups::Nameless::refused), vertex_of_(data.nodes.size(), -1) {}

  mesh::CoarseMesh build() {
    check_flat();
    cells_.mesh.regions = groups_.regions();
    for (const MeshElement& element : data_.elements)
      if (const ElementType type = *element_type(element.type); type.is_cell()) add_cell(element, type);
    if (cells_.mesh.cells.empty()) refuse_without_cells(data_, shape_);
    cells_.mesh.boundaries = groups_.boundaries();
    const auto edges = edges_of(cells_.mesh.cells);
    check_cells_fit(cells_, edges, data_.source);
    add_boundaries(edges);
    return shaped();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw mesh::DomainError(data_.source + ": " + what); }

  const MeshNode& node(const MeshElement& element, std::size_t i) const {
    return data_.nodes[data_.element_nodes[element.first_node + i]];
  }

  /// The vertex index of a node, assigned at its first use as a corner.
  int vertex(const MeshElement& element, std::size_t i) {
    int& index = vertex_of_[data_.element_nodes[element.first_node + i]];
    if (index < 0) {
      index = static_cast<int>(cells_.mesh.vertices.size());
      cells_.mesh.vertices.push_back(node(element, i).position.head<2>());
    }
    return index;
  }

  void add_cell(const MeshElement& element, const ElementType& type) {
    check_cell_type(data_, type, shape_);
    const Tables& tables = tables_of(type);
    std::vector<Vector2d> nodes(tables.places.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[tables.places[i]] = node(element, i).position.head<2>();
    const bool is_clockwise = check_map(element, tables.jacobian, nodes);
    mesh::CoarseCell cell{.vertices = {vertex(element, 0), vertex(element, 1), -1, -1},
                          .region = groups_.region(element),
                          .map = {mesh::TriangleLagrangeMap{type.order, {}}}};
    if (type.shape() == mesh::Shape::triangle) {
      cell.vertices[2] = vertex(element, 2);
      cell.map.map = mesh::TriangleLagrangeMap{type.order, std::move(nodes)};
    } else {  // Gmsh's corners run round the cell
      cell.vertices[3] = vertex(element, 2);
      cell.vertices[2] = vertex(element, 3);
      cell.map.map = mesh::LagrangeMap{type.order, std::move(nodes)};
    }
    if (is_clockwise) {  // swaps its two coordinates, so that every a_3 points to the same side
      std::swap(cell.vertices[1], cell.vertices[2]);
      cell.map.axes << 0, 1, 1, 0;
    }
    cells_.mesh.cells.push_back(std::move(cell));
    cells_.elements.push_back(&element);
  }

  /// Returns true if the cell is drawn clockwise. Refuses a cell whose map is not one to one.
  bool check_map(const MeshElement& element, const mesh::LatticeTable& table,
                 const std::vector<Vector2d>& nodes) const {
    const JacobianRange range = jacobian_range(table, nodes);
    if (range.is_positive || range.is_negative) return range.is_negative;
    refuse(
        fmt::format("{} folds over or is degenerate at x = {:.6g}, y = {:.6g}: the determinant of its map vanishes or "
                    "changes its sign; all corners must be below 180 degrees, no two nodes may coincide, and no "
                    "curved side may reach through the cell",
                    place_of(element), range.worst[0], range.worst[1]));
  }

  struct Tables {
    std::vector<std::size_t> places;
    mesh::LatticeTable jacobian;
  };

  const Tables& tables_of(const ElementType& type) {
    const auto [found, is_new] = tables_.try_emplace({type.shape(), type.order});
    if (is_new) found->second = {lattice_places(type.shape(), type.order), jacobian_table(type.shape(), type.order)};
    return found->second;
  }

  /// Checks that nodes of cells lie in the plane, up to rounding relative to the mesh's size.
  void check_flat() const {
    constexpr double negligible = 1e-9;
    Vector2d low = Vector2d::Constant(HUGE_VAL), high = -low;
    const MeshNode* highest = nullptr;
    for (const MeshElement& element : data_.elements) {
      const ElementType type = *element_type(element.type);
      if (!type.is_cell()) continue;
      for (std::size_t i = 0; i < static_cast<std::size_t>(type.nodes); ++i) {
        const MeshNode& n = node(element, i);
        low = low.cwiseMin(n.position.head<2>());
        high = high.cwiseMax(n.position.head<2>());
        if (!highest || std::abs(n.position[2]) > std::abs(highest->position[2])) highest = &n;
      }
    }
    if (highest && !(std::abs(highest->position[2]) <= negligible * (high - low).maxCoeff()))
      refuse(fmt::format("node {} has z = {:g}; the mesh must lie in the parameter plane z = 0, the chart lifts it",
                         highest->tag, highest->position[2]));
  }

  void add_boundaries(const std::vector<mesh::MeshEdge>& edges) {
    std::set<std::array<int, 3>> known;
    for (const MeshElement& element : data_.elements) {
      const auto& groups = data_.group_sets[element.groups];
      if (element_type(element.type)->is_cell() || groups.empty()) continue;
      const std::array<int, 2> drawn{vertex_or_none(element, 0), vertex_or_none(element, 1)};
      const std::array<int, 2> ends{std::min(drawn[0], drawn[1]), std::max(drawn[0], drawn[1])};
      const auto edge = std::ranges::lower_bound(edges, ends, {}, &mesh::MeshEdge::ends);
      if (edge == edges.end() || edge->ends != ends)
        refuse_line(data_, element, cells_.mesh.boundaries[groups_.boundary(groups.front())]);
      for (const int group : groups) {
        const int boundary = groups_.boundary(group);
        if (!known.insert({ends[0], ends[1], boundary}).second) continue;
        cells_.mesh.edges.push_back({group > 0 ? drawn : std::array{drawn[1], drawn[0]}, boundary});
      }
    }
  }

  int vertex_or_none(const MeshElement& element, std::size_t i) const {
    return vertex_of_[data_.element_nodes[element.first_node + i]];
  }

  /// Returns cells of the requested shape: for triangles, quadrilaterals are cut.
  mesh::CoarseMesh shaped() {
    mesh::CoarseMesh mesh = std::move(cells_.mesh);
    mesh.shape = shape_;
    if (shape_ == mesh::Shape::quadrilateral) return mesh;
    const auto cells = std::exchange(mesh.cells, {});
    for (const mesh::CoarseCell& cell : cells)
      if (cell.vertices[3] < 0)
        mesh.cells.push_back(cell);
      else
        mesh::cut_crosswise(cell, mesh);
    return mesh;
  }

  const MeshData& data_;
  mesh::Shape shape_;
  MeshGroups groups_;
  FileCells cells_;
  std::vector<int> vertex_of_;  ///< vertex index of each node, -1 if none
  std::map<std::pair<mesh::Shape, int>, Tables> tables_;
};

}  // namespace

mesh::CoarseMesh build_coarse_mesh(const MeshData& data, mesh::Shape shape) { return Builder(data, shape).build(); }

}  // namespace plastron::domain
