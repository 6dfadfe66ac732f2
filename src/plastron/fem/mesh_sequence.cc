#include <plastron/fem/mesh_sequence.hpp>

#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/algebra/vector.hpp>
#include <plastron/fem/cut_mesh.hpp>
#include <plastron/fem/quadrilateral_sequence.hpp>
#include <plastron/fem/triangle_sequence.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <variant>

namespace plastron::fem {

struct MeshSequence::Storage {
  std::variant<QuadrilateralSequence, TriangleSequence> levels;
  std::shared_ptr<const mesh::CoarseMesh> first;  ///< mesh before any cuts, in the sequence's order
  Finish finish{};
  Even even{};
  std::shared_ptr<const Space> finished{};

  std::shared_ptr<const Space> bare() const {
    return std::visit([](const auto& of_shape) { return of_shape.space(); }, levels);
  }
  void finish_level() { finished = finish ? finish(bare()) : bare(); }
};

namespace {

/// Returns the same owned values with the ghosts of another layout (collective).
algebra::Vector on_layout(const std::shared_ptr<const algebra::Layout>& layout, const algebra::Vector& v) {
  algebra::Vector other(layout, v.block());
  std::ranges::copy(v.owned(), other.owned().begin());
  other.update_ghosts();
  return other;
}

/// Interpolates a field in a space of another degree on the same cells in the same order (collective). The field has
/// values per node of a space of quadrilaterals. It does not change if the degree is not lower.
algebra::Vector at_degree_of(const algebra::Vector& field, const Space& from, const Space& to) {
  PLASTRON_ASSERT(from.owned_cells == to.owned_cells, from.owned_cells, to.owned_cells);
  const Eigen::MatrixXd line =
      mesh::lagrange_table(mesh::gauss_lobatto(from.degree + 1).points, mesh::gauss_lobatto(to.degree + 1).points)
          .value;
  const auto n = static_cast<std::size_t>(from.degree) + 1, m = static_cast<std::size_t>(to.degree) + 1;
  const auto block = static_cast<std::size_t>(field.block());
  algebra::Vector result(to.layout, field.block());
  for (std::size_t cell = 0; cell < to.owned_cells; ++cell)
    for (std::size_t k = 0; k < block; ++k) {
      Eigen::MatrixXd values(n, n);  // a row per xi_1
      for (std::size_t i = 0; i < n * n; ++i)
        values(static_cast<Eigen::Index>(i % n), static_cast<Eigen::Index>(i / n)) =
            field.local()[static_cast<std::size_t>(from.nodes(cell)[i]) * block + k];
      const Eigen::MatrixXd raised = line * values * line.transpose();
      for (std::size_t i = 0; i < m * m; ++i) {
        const auto node = static_cast<std::size_t>(to.nodes(cell)[i]);
        if (node < static_cast<std::size_t>(to.layout->owned))
          result.owned()[node * block + k] = raised(static_cast<Eigen::Index>(i % m), static_cast<Eigen::Index>(i / m));
      }
    }
  result.update_ghosts();
  return result;
}

/// A number that distinguishes coarse meshes by everything except coordinates: cells, edges, their order and names.
class Fingerprint {
 public:
  explicit Fingerprint(const mesh::CoarseMesh& mesh) {
    add(mesh.shape == mesh::Shape::triangle);
    for (const mesh::CoarseCell& cell : mesh.cells) {
      for (const int v : cell.vertices) add(static_cast<std::uint64_t>(v));
      add(static_cast<std::uint64_t>(cell.region));
    }
    for (const mesh::BoundaryEdge& edge : mesh.edges)
      for (const int v : {edge.vertices[0], edge.vertices[1], edge.boundary}) add(static_cast<std::uint64_t>(v));
    for (const auto* names : {&mesh.regions, &mesh.boundaries})
      for (const std::string& name : *names)
        for (const char c : name) add(static_cast<std::uint64_t>(c));
  }
  /// The number, exact as a double.
  double value() const { return static_cast<double>(value_ >> 12); }

 private:
  void add(std::uint64_t item) { value_ = algebra::hash(value_ ^ item); }
  std::uint64_t value_ = 0;
};

/// Sum of the coordinates weighted by place. It is not part of the fingerprint: machines of one job may round sines
/// and cosines differently.
double weighed_coordinates(const mesh::CoarseMesh& mesh) {
  double sum = 0, place = 0;
  for (const Vector2d& v : mesh.vertices)
    for (const double x : v) sum += std::abs(x) * ++place;
  return sum;
}

// Every rank makes its mesh, and may read it, separately. Ranks with different meshes would block each other, or
// compute nonsense.
void check_that_all_have_one_mesh(const mesh::CoarseMesh& mesh, MPI_Comm comm) {
  constexpr double rounding = 1e-10;
  const auto spread = [&](double mine) {
    const double low = algebra::min_over_ranks(mine, comm), high = algebra::max_over_ranks(mine, comm);
    return high > low ? (high - low) / std::max(std::abs(low), std::abs(high)) : 0.0;
  };
  const bool differ_in_shape = spread(Fingerprint(mesh).value()) > 0;
  const bool differ_in_place = spread(weighed_coordinates(mesh)) > rounding;
  if (differ_in_shape || differ_in_place)
    throw mesh::DomainError(
        "the processes of this job have different meshes: give all of them the same case and the same mesh file");
}

/// The owned cells with a node on some boundaries. A corner suffices: a node that hangs beside it would depend on it.
std::vector<std::size_t> cells_along(const Space& space, const std::vector<std::string>& boundaries) {
  const auto is_named = [&](const BoundarySide& side) {
    return side.boundary >= 0 &&
           std::ranges::find(boundaries, space.coarse->boundaries[side.boundary]) != boundaries.end();
  };
  std::vector<char> is_on(static_cast<std::size_t>(space.layout->local_size()), 0);
  for (const BoundarySide& side : space.sides)
    if (is_named(side))
      for (const int k : mesh::side_nodes(space.shape(), space.degree, side.side)) is_on[space.nodes(side.cell)[k]] = 1;
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < space.owned_cells; ++cell)
    if (std::ranges::any_of(space.nodes(cell), [&](auto node) { return is_on[node] != 0; })) cells.push_back(cell);
  return cells;
}

/// Marks the cells along even boundaries that are larger than others of their group. Empty if all cells of each group have one size
/// (collective).
std::vector<signed char> larger_cells(const Space& space, const MeshSequence::Even& even) {
  const MPI_Comm comm = space.layout->comm;
  std::vector<signed char> marks(space.owned_cells, 0);
  for (const std::vector<std::string>& group : even) {
    const std::vector<std::size_t> cells = cells_along(space, group);
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t cell : cells) least = std::min(least, std::abs(space.cells[cell].size));
    least = algebra::min_over_ranks(least, comm);
    for (const std::size_t cell : cells)
      if (std::abs(space.cells[cell].size) > 1.5 * least) marks[cell] = 1;
  }
  const std::int64_t mine = std::ranges::count(marks, 1);
  return algebra::sum_over_ranks(mine, comm) > 0 ? marks : std::vector<signed char>{};
}

}  // namespace

void mark_evenly(const Space& space, const MeshSequence::Even& even, std::span<signed char> marks) {
  // A cell may lie along boundaries of several groups.
  for (std::size_t round = 0; round < even.size(); ++round)
    for (const std::vector<std::string>& group : even) {
      const std::vector<std::size_t> cells = cells_along(space, group);
      const std::int64_t mine = std::ranges::count_if(cells, [&](std::size_t cell) { return marks[cell] > 0; });
      if (algebra::sum_over_ranks(mine, space.layout->comm) > 0)
        for (const std::size_t cell : cells) marks[cell] = 1;
    }
}

MeshSequence::MeshSequence(mesh::CoarseMesh coarse, int degree, MPI_Comm comm, Finish finish, Even even) {
  check_that_all_have_one_mesh(coarse, comm);
  if (coarse.shape == mesh::Shape::triangle)
    storage_ =
        std::make_unique<Storage>(Storage{TriangleSequence(std::move(coarse), degree, comm), {}, std::move(finish)});
  else
    storage_ = std::make_unique<Storage>(
        Storage{QuadrilateralSequence(std::move(coarse), degree, comm), {}, std::move(finish)});
  storage_->even = std::move(even);
  storage_->finish_level();
  storage_->first = space()->coarse;
}

MeshSequence::~MeshSequence() = default;
MeshSequence::MeshSequence(MeshSequence&&) noexcept = default;
MeshSequence& MeshSequence::operator=(MeshSequence&&) noexcept = default;

std::shared_ptr<const Space> MeshSequence::space() const { return storage_->finished; }

void MeshSequence::cut(std::span<algebra::Vector> fields, std::span<const mesh::Cuts> cuts) {
  const std::shared_ptr<const Space> before = space();
  PLASTRON_ASSERT(before->global_cells == static_cast<std::int64_t>(before->coarse->cells.size()));
  restart(with_cuts(*before->coarse, cuts));
  for (algebra::Vector& field : fields) field = interpolated(field, *before, *space());
}

void MeshSequence::begin_with_cuts(std::vector<mesh::Cuts> cuts) {
  if (!is_graded() || !are_conforming(*storage_->first, cuts))
    throw mesh::DomainError("cuts through cells that are not those of the mesh");
  restart(std::move(cuts));
}

void MeshSequence::restart(std::vector<mesh::Cuts> cuts) {
  const MPI_Comm comm = space()->layout->comm;
  mesh::CoarseMesh mesh = cut_mesh(*storage_->first, std::move(cuts));
  check_that_all_have_one_mesh(mesh, comm);
  const double fingerprint = Fingerprint(mesh).value();
  storage_->levels = QuadrilateralSequence(std::move(mesh), space()->degree, comm);
  // The cells of the first mesh and of its lattices already have consistent directions. They are not reordered
  // (cut_cells).
  PLASTRON_ASSERT(fingerprint ==
                  Fingerprint(*std::get<QuadrilateralSequence>(storage_->levels).space()->coarse).value());
  storage_->finish_level();
}

std::shared_ptr<const Space> MeshSequence::raised(std::span<algebra::Vector> fields, int degrees) const {
  const auto* cells = std::get_if<QuadrilateralSequence>(&storage_->levels);
  if (!cells) return {};
  std::shared_ptr<const Space> same_cells = cells->space_of_degree(space()->degree + degrees);
  if (storage_->finish) same_cells = storage_->finish(std::move(same_cells));
  for (algebra::Vector& field : fields) field = at_degree_of(field, *space(), *same_cells);
  return same_cells;
}

bool MeshSequence::is_graded() const { return std::holds_alternative<QuadrilateralSequence>(storage_->levels); }

void MeshSequence::refine(std::span<algebra::Vector> fields) { refine_where(fields, {}); }

void MeshSequence::refine(std::span<algebra::Vector> fields, std::span<const signed char> marks) {
  PLASTRON_ASSERT(marks.size() == space()->owned_cells, marks.size(), space()->owned_cells);
  const std::int64_t mine = std::ranges::count(marks, 1);
  if (is_graded())
    refine_where(fields, marks);
  else if (algebra::sum_over_ranks(mine, space()->layout->comm) > 0)
    refine_where(fields, {});
}

/// Neighbours of divided cells may lie along an even boundary and be divided too. Then the others of their group are
/// divided as well.
void MeshSequence::refine_evenly(QuadrilateralSequence& cells, std::span<algebra::Vector> fields, Marks marks) {
  cells.refine(fields, marks);
  if (storage_->even.empty()) return;
  for (auto larger = larger_cells(*cells.space(), storage_->even); !larger.empty();
       larger = larger_cells(*cells.space(), storage_->even))
    cells.refine(fields, larger);
}

void MeshSequence::refine_where(std::span<algebra::Vector> fields, Marks marks) {
  const bool has_own_layout = storage_->finished->layout != storage_->bare()->layout;
  if (has_own_layout)
    for (algebra::Vector& field : fields) field = on_layout(storage_->bare()->layout, field);
  if (auto* cells = std::get_if<QuadrilateralSequence>(&storage_->levels))
    refine_evenly(*cells, fields, marks);
  else
    std::get<TriangleSequence>(storage_->levels).refine(fields);
  storage_->finish_level();
  if (storage_->finished->layout != storage_->bare()->layout)
    for (algebra::Vector& field : fields) field = on_layout(storage_->finished->layout, field);
}

}  // namespace plastron::fem
