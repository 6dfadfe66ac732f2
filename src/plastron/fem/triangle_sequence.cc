#include <plastron/fem/triangle_sequence.hpp>

#include <plastron/mesh/basis.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace plastron::fem {

namespace {

std::array<int, 2> sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Returns the half of an edge at one of its vertices: edge e becomes 2e (at its first vertex) and 2e + 1.
int half(const TriangleTopology& mesh, int edge, int vertex) {
  return 2 * edge + (mesh.edges[edge][0] == vertex ? 0 : 1);
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
  for (std::size_t k = 0; k < 3; ++k) fine.edges[inner[k]] = {middle[k], middle[(k + 2) % 3]};
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
  return {.corner = mesh::corner(mesh::Shape::triangle, child) / 2, .size = 0.5};
}

TriangleTopology coarse_topology(const mesh::CoarseMesh& mesh) {
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
  throw mesh::DomainError(
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

namespace {

using algebra::GlobalIndex;

/// The entities of a cell's nodes in lexicographic order: vertices by number, edges after them.
std::vector<std::size_t> node_entities(const TriangleTopology& mesh, int degree, std::size_t cell) {
  const auto& v = mesh.vertices[cell];
  if (degree == 1) return {v.begin(), v.end()};
  const auto edge = [&](std::size_t s) {
    return static_cast<std::size_t>(mesh.vertex_count) + static_cast<std::size_t>(mesh.sides[cell][s]);
  };
  const auto vertex = [&](std::size_t k) { return static_cast<std::size_t>(v[k]); };
  return {vertex(0), edge(0), vertex(1), edge(2), edge(1), vertex(2)};
}

TriangleNumbering numbering(const TriangleTopology& mesh, int degree, int ranks) {
  const std::size_t edges = degree == 1 ? 0 : mesh.edges.size();
  TriangleNumbering numbers{.number =
                                std::vector<GlobalIndex>(static_cast<std::size_t>(mesh.vertex_count) + edges, -1)};
  GlobalIndex next = 0;
  std::size_t cell = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    numbers.first_cell.push_back(cell);
    numbers.first_node.push_back(next);
    const std::size_t end = mesh.cells.size() * static_cast<std::size_t>(rank + 1) / static_cast<std::size_t>(ranks);
    for (; cell < end; ++cell)
      for (const std::size_t entity : node_entities(mesh, degree, cell))
        if (numbers.number[entity] < 0) numbers.number[entity] = next++;
  }
  numbers.first_cell.push_back(cell);
  numbers.first_node.push_back(next);
  return numbers;
}

/// Cells of other ranks that share a vertex with a cell of [begin, end).
std::vector<std::size_t> cells_around(const TriangleTopology& mesh, std::size_t begin, std::size_t end) {
  std::vector<char> touched(static_cast<std::size_t>(mesh.vertex_count), 0);
  for (std::size_t c = begin; c < end; ++c)
    for (const int v : mesh.vertices[c]) touched[v] = 1;
  std::vector<std::size_t> around;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if ((c < begin || c >= end) && std::ranges::any_of(mesh.vertices[c], [&](int v) { return touched[v] != 0; }))
      around.push_back(c);
  return around;
}

/// Matrix from values at the nodes of a parent to values at the nodes of child k: a row per node of the child.
Eigen::MatrixXd to_child(int degree, int k) {
  const Cell child = child_cell(k);
  const auto nodes = mesh::lattice(mesh::Shape::triangle, degree);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    matrix.row(i) = mesh::lattice_values(mesh::Shape::triangle, degree, child.corner + child.size * nodes[i]).value;
  return matrix;
}

}  // namespace

TriangleSequence::TriangleSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm)
    : coarse_(std::make_shared<const mesh::CoarseMesh>(std::move(coarse))),
      degree_(degree),
      comm_(comm),
      sides_(*coarse_),
      mesh_(coarse_topology(*coarse_)) {
  if (degree != 1 && degree != 2)
    throw mesh::DomainError(fmt::format("triangles have degree 1 or 2, not {}; take quadrilaterals for more", degree));
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &ranks_);
  flatten();
}

void TriangleSequence::add_cell(std::size_t cell, Space& target) const {
  const algebra::Layout& layout = *target.layout;
  for (const std::size_t entity : node_entities(mesh_, degree_, cell))
    target.connectivity.nodes.push_back(layout.local(numbers_.number[entity]));
  target.cells.push_back(mesh_.cells[cell]);
  sides_.add_sides_of_last_cell(target);
}

void TriangleSequence::flatten() {
  numbers_ = numbering(mesh_, degree_, ranks_);
  const auto rank = static_cast<std::size_t>(rank_);
  const std::size_t begin = numbers_.first_cell[rank], end = numbers_.first_cell[rank + 1];
  const auto around = cells_around(mesh_, begin, end);

  algebra::Distribution nodes{
      .comm = comm_,
      .first = numbers_.first_node[rank],
      .owned = static_cast<algebra::LocalIndex>(numbers_.first_node[rank + 1] - numbers_.first_node[rank]),
      .global_size = numbers_.first_node.back()};
  std::vector<GlobalIndex> seen;
  const auto see = [&](std::size_t cell) {
    for (const std::size_t entity : node_entities(mesh_, degree_, cell))
      if (!nodes.owns(numbers_.number[entity])) seen.push_back(numbers_.number[entity]);
  };
  if (ranks_ > 1)
    for (std::size_t c = begin; c < end; ++c) see(c);
  for (const std::size_t c : around) see(c);
  nodes.add_ghosts(std::move(seen));

  Space flat{.degree = degree_,
             .coarse = coarse_,
             .layout = std::make_shared<const algebra::Layout>(std::move(nodes)),
             .owned_cells = end - begin,
             .global_cells = static_cast<std::int64_t>(mesh_.cells.size())};
  flat.connectivity.nodes_per_element = flat.nodes_per_cell();
  for (std::size_t c = begin; c < end; ++c) add_cell(c, flat);
  for (const std::size_t c : around) add_cell(c, flat);
  space_ = std::make_shared<const Space>(std::move(flat));
}

// After refinement, this rank owns children of its own cells and possibly of the first cell after them.
std::shared_ptr<const algebra::Layout> TriangleSequence::layout_of_parents() const {
  const std::size_t behind = numbers_.first_cell[static_cast<std::size_t>(rank_) + 1];
  algebra::Distribution nodes = *space_->layout;
  std::vector<GlobalIndex> seen;
  if (behind < mesh_.cells.size())
    for (const std::size_t entity : node_entities(mesh_, degree_, behind)) seen.push_back(numbers_.number[entity]);
  nodes.add_ghosts(std::move(seen));
  return std::make_shared<const algebra::Layout>(std::move(nodes));
}

void TriangleSequence::refine(std::span<algebra::Vector> fields) {
  if (!fields.empty()) {
    const auto of_parents = layout_of_parents();
    for (algebra::Vector& field : fields) {
      algebra::Vector seen(of_parents, field.block());
      std::ranges::copy(field.owned(), seen.owned().begin());
      seen.update_ghosts();
      field = std::move(seen);
    }
  }
  const Refinement from{.mesh = std::exchange(mesh_, refined(mesh_)), .numbers = std::move(numbers_)};
  flatten();
  for (algebra::Vector& field : fields) field = interpolated(field, from);
}

algebra::Vector TriangleSequence::interpolated(const algebra::Vector& coarse, const Refinement& from) const {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd children[4] = {to_child(degree_, 0), to_child(degree_, 1), to_child(degree_, 2),
                                       to_child(degree_, 3)};
  const std::size_t first = numbers_.first_cell[rank_];
  const auto block = static_cast<Eigen::Index>(coarse.block());
  algebra::Vector fine(space_->layout, coarse.block());
  for (std::size_t c = 0; c < space_->owned_cells; ++c) {
    const std::size_t cell = first + c;
    const auto parents = node_entities(from.mesh, degree_, cell / 4);
    Rows of_parent(static_cast<Eigen::Index>(parents.size()), block);
    for (std::size_t j = 0; j < parents.size(); ++j) {
      const algebra::LocalIndex node = coarse.layout()->local(from.numbers.number[parents[j]]);
      of_parent.row(static_cast<Eigen::Index>(j)) =
          Eigen::Map<const Eigen::RowVectorXd>(coarse.local().data() + node * block, block);
    }
    const Rows of_child = children[cell % 4] * of_parent;
    const auto nodes = space_->nodes(c);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i] < space_->layout->owned)
        std::copy_n(of_child.row(static_cast<Eigen::Index>(i)).data(), block,
                    fine.owned().begin() + static_cast<std::ptrdiff_t>(nodes[i]) * block);
  }
  fine.update_ghosts();
  return fine;
}

}  // namespace plastron::fem
