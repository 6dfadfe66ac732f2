// Graded meshes on 1, 2 and 3 ranks. Fields are continuous, polynomials of the elements' degree are in the
// space and are transferred exactly, and nothing depends on the distribution of the mesh.
#include <gtest/gtest.h>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/mesh_sequence.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plastron::fem {
namespace {

constexpr double place_unit = 1e9;

Vector2d middle(const Cell& cell) { return cell.corner + cell.size * Vector2d(0.5, 0.5); }

/// By the place of the cell, so that all numbers of ranks mark alike: one third is divided, one third kept, one third joined.
std::vector<signed char> scattered_marks(const Space& space, std::uint64_t seed) {
  std::vector<signed char> marks;
  for (std::size_t c = 0; c < space.owned_cells; ++c) {
    const Vector2d at = middle(space.cells[c]);
    const auto place =
        static_cast<std::uint64_t>(std::llround(place_unit * at[0]) * 31 + std::llround(place_unit * at[1]));
    const auto number = algebra::hash(place + 1000003 * static_cast<std::uint64_t>(space.cells[c].coarse) + seed);
    marks.push_back(static_cast<signed char>(static_cast<int>(number % 3) - 1));
  }
  return marks;
}

/// Parameters of the nodes (block 2), the same for all cells that share a node.
algebra::Vector positions(const Space& space) {
  const auto line = mesh::gauss_lobatto(space.degree + 1).points;
  algebra::Vector x(space.layout, 2);
  for (std::size_t c = 0; c < space.cells.size(); ++c)
    for (std::size_t i = 0; i < space.nodes(c).size(); ++i) {
      const std::size_t k = line.size();
      const Vector2d at = space.coarse->cells[static_cast<std::size_t>(space.cells[c].coarse)]
                              .map(space.cells[c].corner + space.cells[c].size * Vector2d(line[i % k], line[i / k]))
                              .value;
      for (std::size_t d = 0; d < 2; ++d)
        x.local()[2 * static_cast<std::size_t>(space.nodes(c)[i]) + d] = at[static_cast<Eigen::Index>(d)];
    }
  x.update_ghosts();
  return x;
}

double polynomial(int k, double x, double y) {
  return std::pow(x - 0.3, k) * (1 + std::pow(y + 0.2, k)) - 2 * x * y + 1;
}

algebra::Vector interpolant(const Space& space) {
  const algebra::Vector x = positions(space);
  algebra::Vector v(space.layout, 1);
  for (std::size_t i = 0; i < v.local().size(); ++i)
    v.local()[i] = polynomial(space.degree, x.local()[2 * i], x.local()[2 * i + 1]);
  return v;
}

double largest_difference(const algebra::Vector& a, const algebra::Vector& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.local().size(); ++i) most = std::max(most, std::abs(a.local()[i] - b.local()[i]));
  return algebra::max_over_ranks(most, a.layout()->comm);
}

MeshSequence square(int degree, MPI_Comm comm = MPI_COMM_WORLD) {
  return {domain::coarse_mesh(domain::Rectangle{.to = {1.5, 1}, .cells = {3, 2}}, mesh::Shape::quadrilateral), degree,
          comm};
}

constexpr int rounds = 5;

class GradedMesh : public testing::TestWithParam<int> {};

TEST_P(GradedMesh, HoldsPolynomialsAndCarriesThem) {
  MeshSequence meshes = square(GetParam());
  std::vector<algebra::Vector> fields{interpolant(*meshes.space())};
  std::int64_t hanging = 0;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    meshes.refine(fields, scattered_marks(*meshes.space(), round));
    const Space& space = *meshes.space();
    const algebra::Vector exact = interpolant(space);
    EXPECT_LT(largest_difference(fields[0], exact), 1e-11);
    algebra::Vector spread_out = exact;
    space.continuity.apply(spread_out);
    EXPECT_LT(largest_difference(spread_out, exact), 1e-12);
    const auto rows = static_cast<std::int64_t>(space.continuity.rows().size());
    hanging += rows;
    EXPECT_EQ(space.continuity.is_identity(), algebra::sum_over_ranks(rows, MPI_COMM_WORLD) == 0);
  }
  EXPECT_GT(algebra::sum_over_ranks(hanging, MPI_COMM_WORLD), 20);
}

TEST_P(GradedMesh, HasTheSameCellsAndFieldsAtOneDegreeMore) {
  MeshSequence meshes = square(GetParam());
  for (std::uint64_t round = 0; round < rounds; ++round) meshes.refine({}, scattered_marks(*meshes.space(), round));
  const std::shared_ptr<const Space> before = meshes.space();
  std::vector<algebra::Vector> fields{interpolant(*before)};
  const std::shared_ptr<const Space> raised = meshes.raised(fields);
  EXPECT_EQ(meshes.space(), before);
  ASSERT_EQ(raised->degree, before->degree + 1);
  ASSERT_EQ(raised->owned_cells, before->owned_cells);
  for (std::size_t c = 0; c < before->owned_cells; ++c)
    EXPECT_EQ(place_of(raised->cells[c]), place_of(before->cells[c]));
  const algebra::Vector x = positions(*raised);
  algebra::Vector exact(raised->layout, 1);
  for (std::size_t i = 0; i < exact.local().size(); ++i)
    exact.local()[i] = polynomial(before->degree, x.local()[2 * i], x.local()[2 * i + 1]);
  EXPECT_LT(largest_difference(fields[0], exact), 1e-11);
  algebra::Vector spread_out = exact;
  raised->continuity.apply(spread_out);
  EXPECT_LT(largest_difference(spread_out, exact), 1e-12);
}

TEST(MeshesOfTriangles, HaveNoHigherDegree) {
  MeshSequence meshes(domain::coarse_mesh(domain::Rectangle{}, mesh::Shape::triangle), 2, MPI_COMM_WORLD);
  EXPECT_EQ(meshes.raised({}), nullptr);
}

/// Any values at free nodes give a field with one value at every point of a side, from either cell.
TEST_P(GradedMesh, HasContinuousFields) {
  MeshSequence meshes = square(GetParam());
  for (std::uint64_t round = 0; round < rounds; ++round) meshes.refine({}, scattered_marks(*meshes.space(), round));
  const Space& space = *meshes.space();
  algebra::Vector v(space.layout, 1);
  for (algebra::LocalIndex i = 0; i < space.layout->local_size(); ++i)
    v.local()[static_cast<std::size_t>(i)] = std::sin(7.0 * static_cast<double>(space.layout->global(i)));
  space.continuity.apply(v);
  const auto line = mesh::gauss_lobatto(space.degree + 1).points;
  const auto value = [&](std::size_t c, const Vector2d& coarse_place) {
    const Vector2d xi = (coarse_place - space.cells[c].corner) / space.cells[c].size;
    const auto a = mesh::lagrange(line, xi[0]).value, b = mesh::lagrange(line, xi[1]).value;
    double sum = 0;
    for (Eigen::Index j = 0; j < b.size(); ++j)
      for (Eigen::Index i = 0; i < a.size(); ++i)
        sum += a[i] * b[j] *
               v.local()[static_cast<std::size_t>(space.nodes(c)[static_cast<std::size_t>(j * a.size() + i)])];
    return sum;
  };
  std::int64_t compared = 0;
  for (std::size_t c = 0; c < space.owned_cells; ++c)
    for (std::size_t other = 0; other < space.cells.size(); ++other) {
      const Cell &small = space.cells[c], &large = space.cells[other];
      const double right = small.corner[0] + small.size;
      if (small.coarse != large.coarse || large.corner[0] != right || small.corner[1] < large.corner[1] ||
          small.corner[1] + small.size > large.corner[1] + large.size)
        continue;
      ++compared;
      for (const double t : {0.1, 0.5, 0.8}) {
        const Vector2d at(right, small.corner[1] + t * small.size);
        EXPECT_NEAR(value(c, at), value(other, at), 1e-11);
      }
    }
  EXPECT_GT(algebra::sum_over_ranks(compared, MPI_COMM_WORLD), 10);
}

TEST_P(GradedMesh, HasNoChainsAndNoMasterOutOfSight) {
  MeshSequence meshes = square(GetParam());
  for (std::uint64_t round = 0; round < rounds; ++round) meshes.refine({}, scattered_marks(*meshes.space(), round));
  const Space& space = *meshes.space();
  for (const constraints::Row& row : space.continuity.rows()) {
    double sum = 0;
    for (const auto& [master, weight, block] : row.terms) {
      ASSERT_GE(master, 0);
      ASSERT_LT(master, space.layout->local_size());
      EXPECT_FALSE(space.continuity.constrains(static_cast<std::size_t>(master)));
      EXPECT_FALSE(block);
      sum += weight;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST_P(GradedMesh, IsTheSameOnAnyNumberOfRanks) {
  MeshSequence together = square(GetParam()), alone = square(GetParam(), MPI_COMM_SELF);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    together.refine({}, scattered_marks(*together.space(), round));
    alone.refine({}, scattered_marks(*alone.space(), round));
    EXPECT_EQ(together.space()->global_cells, alone.space()->global_cells);
    EXPECT_EQ(together.space()->layout->global_size, alone.space()->layout->global_size);
    const auto owned_rows = [](const Space& space) {
      return std::ranges::count_if(space.continuity.rows(),
                                   [&](const constraints::Row& row) { return row.node < space.layout->owned; });
    };
    EXPECT_EQ(algebra::sum_over_ranks(static_cast<std::int64_t>(owned_rows(*together.space())), MPI_COMM_WORLD),
              owned_rows(*alone.space()));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, GradedMesh, testing::Values(1, 2, 3, 4, 7));

TEST(GradedTriangles, AreDividedTogether) {
  MeshSequence meshes(domain::coarse_mesh(domain::Disk{}, mesh::Shape::triangle), 2, MPI_COMM_WORLD);
  EXPECT_FALSE(meshes.is_graded());
  const auto cells = meshes.space()->global_cells;
  std::vector<signed char> marks(meshes.space()->owned_cells, 0);
  meshes.refine({}, marks);
  EXPECT_EQ(meshes.space()->global_cells, cells);
  if (!marks.empty()) marks[0] = 1;
  meshes.refine({}, marks);
  EXPECT_EQ(meshes.space()->global_cells, 4 * cells);
}

}  // namespace
}  // namespace plastron::fem
