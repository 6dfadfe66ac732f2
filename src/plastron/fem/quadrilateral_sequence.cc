#include <plastron/fem/quadrilateral_sequence.hpp>

#include <plastron/fem/constraints.hpp>
#include <plastron/fem/named_sides.hpp>

#include <deal.II/base/multithread_info.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <p4est.h>

#include <algorithm>
#include <optional>

namespace plastron::fem {

namespace {

using DealVector = dealii::LinearAlgebra::distributed::Vector<double>;

/// Makes p4est silent; otherwise it writes to standard output. This is possible only once per process, and a program
/// that uses the library may have started p4est already. Each process starts it separately, because one process may
/// have a mesh before the others, or alone.
void silence_p4est() {
  [[maybe_unused]] static const bool once = [] {
    if (sc_package_id < 0) sc_init(MPI_COMM_SELF, 0, 0, nullptr, SC_LP_SILENT);
    if (p4est_package_id < 0) p4est_init(nullptr, SC_LP_SILENT);
    dealii::MultithreadInfo::set_thread_limit(1);
    return true;
  }();
}

/// Applies deal.II's order of a cell's vertices, for which edges of neighbouring cells run the same way. The exact
/// map of the cell is composed with the rotation or reflection of the new order.
void reorder_vertices(mesh::CoarseCell& cell, const std::array<int, 4>& order) {
  const auto corner = [&](int vertex) -> Vector2d {
    const auto k = std::ranges::find(cell.vertices, vertex) - cell.vertices.begin();
    const auto column = k % 2, row = k / 2;
    return {static_cast<double>(column), static_cast<double>(row)};
  };
  const Vector2d p0 = corner(order[0]), p1 = corner(order[1]), p2 = corner(order[2]);
  Eigen::Matrix2d axes;
  axes << p1 - p0, p2 - p0;
  cell.map.origin += cell.map.axes * p0;
  cell.map.axes = (cell.map.axes * axes).eval();
  cell.vertices = order;
}

std::vector<dealii::CellData<2>> ordered_cells(mesh::CoarseMesh& coarse) {
  std::vector<dealii::CellData<2>> cells(coarse.cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (unsigned int v = 0; v < 4; ++v) cells[c].vertices[v] = static_cast<unsigned int>(coarse.cells[c].vertices[v]);
  dealii::GridTools::consistently_order_cells(cells);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::array<int, 4> order{};
    for (unsigned int v = 0; v < 4; ++v) order[v] = static_cast<int>(cells[c].vertices[v]);
    reorder_vertices(coarse.cells[c], order);
  }
  return cells;
}

/// Returns the place of a cell in its coarse cell. Coarse cells are identified by their index: p4est numbers its
/// trees differently, and CellId contains the number of p4est.
Cell dyadic_cell(dealii::TriaIterator<dealii::CellAccessor<2>> cell) {
  Cell result;
  // The indices are a view into the id.
  const dealii::CellId id = cell->id();
  for (const auto child : id.get_child_indices()) {
    result.size /= 2;
    result.corner += result.size * Vector2d(child % 2, child / 2);
  }
  while (cell->level() > 0) cell = cell->parent();
  result.coarse = cell->index();
  return result;
}

}  // namespace

/// Nodes of one degree on a mesh.
struct QuadrilateralSequence::Nodes {
  Nodes(const dealii::Triangulation<2>& mesh, int degree) : element(static_cast<unsigned int>(degree)), dofs(mesh) {}
  dealii::FE_Q<2> element;
  dealii::DoFHandler<2> dofs;
  dealii::IndexSet relevant;

  /// Distributes nodes on the present cells.
  void distribute();
  std::shared_ptr<const algebra::Layout> make_layout() const;
  std::vector<HangingNode> hanging_nodes() const;
  DealVector make_vector() const { return {dofs.locally_owned_dofs(), relevant, dofs.get_communicator()}; }
};

void QuadrilateralSequence::Nodes::distribute() {
  dofs.distribute_dofs(element);
  dealii::DoFTools::extract_locally_relevant_dofs(dofs, relevant);
}

std::shared_ptr<const algebra::Layout> QuadrilateralSequence::Nodes::make_layout() const {
  const MPI_Comm comm = dofs.get_communicator();
  const dealii::IndexSet& owned = dofs.locally_owned_dofs();
  const auto count = static_cast<algebra::GlobalIndex>(owned.n_elements());
  // A rank without nodes begins and ends at the end of the previous rank.
  algebra::GlobalIndex end = 0;
  MPI_Scan(&count, &end, 1, MPI_INT64_T, MPI_SUM, comm);
  algebra::Distribution nodes{.comm = comm,
                              .first = end - count,
                              .owned = static_cast<algebra::LocalIndex>(count),
                              .global_size = static_cast<algebra::GlobalIndex>(dofs.n_dofs())};
  for (const auto i : relevant)
    if (!owned.is_element(i)) nodes.ghosts.push_back(static_cast<algebra::GlobalIndex>(i));
  return std::make_shared<const algebra::Layout>(std::move(nodes));
}

/// Returns the hanging nodes owned by this rank.
std::vector<HangingNode> QuadrilateralSequence::Nodes::hanging_nodes() const {
  dealii::AffineConstraints<double> constraints(relevant);
  dealii::DoFTools::make_hanging_node_constraints(dofs, constraints);
  std::vector<HangingNode> all;
  for (const auto& line : constraints.get_lines()) {
    if (!dofs.locally_owned_dofs().is_element(line.index)) continue;
    HangingNode& node = all.emplace_back(HangingNode{.node = static_cast<algebra::GlobalIndex>(line.index)});
    for (const auto& [master, weight] : line.entries)
      node.masters.emplace_back(static_cast<algebra::GlobalIndex>(master), weight);
  }
  return all;
}

struct QuadrilateralSequence::Storage {
  Storage(mesh::CoarseMesh mesh, int degree, MPI_Comm comm)
      : coarse(std::make_shared<mesh::CoarseMesh>(std::move(mesh))),
        triangulation(comm),
        nodes(triangulation, degree) {}

  std::shared_ptr<mesh::CoarseMesh> coarse;
  std::optional<NamedSides> sides;  ///< sides of the coarse cells in deal.II's order of vertices
  dealii::parallel::distributed::Triangulation<2> triangulation;
  Nodes nodes;
  std::shared_ptr<const Space> space;

  void create();
  void number_nodes();
  std::shared_ptr<const Space> flat(const Nodes& of) const;
  void mark_cells(const Marks& marks);
  template <class Accessor>
  void add_cell(const Accessor& cell, const std::vector<unsigned int>& from_lexicographic, Space& target) const;
};

void QuadrilateralSequence::Storage::create() {
  const auto cells = ordered_cells(*coarse);
  std::vector<dealii::Point<2>> vertices;
  for (const Vector2d& v : coarse->vertices) vertices.emplace_back(v[0], v[1]);
  triangulation.create_triangulation(vertices, cells, {});
  sides.emplace(*coarse);
}

template <class Accessor>
void QuadrilateralSequence::Storage::add_cell(const Accessor& cell, const std::vector<unsigned int>& from_lexicographic,
                                              Space& target) const {
  const algebra::Layout& layout = *target.layout;
  std::vector<dealii::types::global_dof_index> indices(from_lexicographic.size());
  cell->get_dof_indices(indices);
  for (unsigned int i = 0; i < indices.size(); ++i) {
    const auto global = static_cast<algebra::GlobalIndex>(indices[from_lexicographic[i]]);
    target.connectivity.nodes.push_back(layout.local(global));
  }
  target.cells.push_back(dyadic_cell(cell));
  sides->add_sides_of_last_cell(target);
}

void QuadrilateralSequence::Storage::mark_cells(const Marks& marks) {
  if (!marks) {
    triangulation.set_all_refine_flags();
    return;
  }
  std::size_t next = 0;
  for (const auto& cell : triangulation.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const signed char mark = (*marks)[next++];
    if (mark > 0) cell->set_refine_flag();
    if (mark < 0 && cell->level() > 0) cell->set_coarsen_flag();
  }
  PLASTRON_ASSERT(next == marks->size(), next, marks->size());
}

std::shared_ptr<const Space> QuadrilateralSequence::Storage::flat(const Nodes& of) const {
  Space flat{.degree = static_cast<int>(of.element.degree), .coarse = coarse, .layout = of.make_layout()};
  flat.connectivity.nodes_per_element = flat.nodes_per_cell();
  const auto from_lexicographic = of.element.get_poly_space_numbering_inverse();
  for (const auto& cell : of.dofs.active_cell_iterators())
    if (cell->is_locally_owned()) add_cell(cell, from_lexicographic, flat);
  flat.owned_cells = flat.cells.size();
  for (const auto& cell : of.dofs.active_cell_iterators())
    if (cell->is_ghost()) add_cell(cell, from_lexicographic, flat);
  flat.global_cells = static_cast<std::int64_t>(triangulation.n_global_active_cells());
  constrain_hanging_nodes(flat, of.hanging_nodes());
  return std::make_shared<const Space>(std::move(flat));
}

void QuadrilateralSequence::Storage::number_nodes() {
  nodes.distribute();
  space = flat(nodes);
}

QuadrilateralSequence::QuadrilateralSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm) {
  silence_p4est();
  storage_ = std::make_unique<Storage>(std::move(coarse), degree, comm);
  storage_->create();
  storage_->number_nodes();
}

QuadrilateralSequence::~QuadrilateralSequence() = default;
QuadrilateralSequence::QuadrilateralSequence(QuadrilateralSequence&&) noexcept = default;
QuadrilateralSequence& QuadrilateralSequence::operator=(QuadrilateralSequence&&) noexcept = default;

std::shared_ptr<const Space> QuadrilateralSequence::space() const { return storage_->space; }

std::shared_ptr<const Space> QuadrilateralSequence::space_of_degree(int degree) const {
  Nodes nodes(storage_->triangulation, degree);
  nodes.distribute();
  return storage_->flat(nodes);
}

void QuadrilateralSequence::refine(std::span<algebra::Vector> fields, Marks marks) {
  Storage& s = *storage_;
  // deal.II transfers scalar fields: one vector for each component of each node field.
  std::vector<DealVector> before;
  for (const algebra::Vector& field : fields)
    for (int c = 0; c < field.block(); ++c) {
      DealVector component = s.nodes.make_vector();
      for (algebra::LocalIndex i = 0; i < s.space->layout->owned; ++i)
        component.local_element(static_cast<unsigned int>(i)) =
            field.owned()[static_cast<std::size_t>(i) * field.block() + c];
      before.push_back(std::move(component));
    }
  std::vector<const DealVector*> inputs;
  for (DealVector& v : before) {
    // Must follow the loop: copies made by a growing std::vector lose their ghosts' values.
    v.update_ghost_values();
    inputs.push_back(&v);
  }

  dealii::parallel::distributed::SolutionTransfer<2, DealVector> transfer(s.nodes.dofs);
  s.mark_cells(marks);
  s.triangulation.prepare_coarsening_and_refinement();
  if (!inputs.empty()) transfer.prepare_for_coarsening_and_refinement(inputs);
  s.triangulation.execute_coarsening_and_refinement();
  s.number_nodes();
  if (inputs.empty()) return;

  std::vector<DealVector> after(before.size());
  std::vector<DealVector*> outputs;
  for (DealVector& v : after) {
    v = s.nodes.make_vector();
    outputs.push_back(&v);
  }
  transfer.interpolate(outputs);

  std::size_t next = 0;
  for (algebra::Vector& field : fields) {
    algebra::Vector refined(s.space->layout, field.block());
    for (int c = 0; c < field.block(); ++c, ++next)
      for (algebra::LocalIndex i = 0; i < s.space->layout->owned; ++i)
        refined.owned()[static_cast<std::size_t>(i) * field.block() + c] =
            after[next].local_element(static_cast<unsigned int>(i));
    refined.update_ghosts();
    field = std::move(refined);
  }
}

std::string deal_ii_version() { return DEAL_II_PACKAGE_VERSION; }

}  // namespace plastron::fem
