// The map of constraints against its definition: rows by weights and by blocks, on rings of nodes over any number of ranks.
#include <gtest/gtest.h>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/constraints/map.hpp>

#include <algorithm>
#include <utility>

namespace plastron::constraints {
namespace {

using algebra::GlobalIndex, algebra::LocalIndex;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr LocalIndex per_rank = 6;

/// Six nodes on each rank, which sees all nodes of the others as ghosts if `sees_all`, else the next two.
std::shared_ptr<const algebra::Layout> ring(bool sees_all = true) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const GlobalIndex size = static_cast<GlobalIndex>(per_rank) * ranks;
  algebra::Distribution nodes{.comm = MPI_COMM_WORLD, .first = rank * per_rank, .owned = per_rank, .global_size = size};
  std::vector<GlobalIndex> ghosts;
  for (GlobalIndex k = 0; k < (sees_all ? size : 2); ++k) {
    const GlobalIndex node = (nodes.first + per_rank + k) % size;
    if (!nodes.owns(node)) ghosts.push_back(node);
  }
  nodes.add_ghosts(std::move(ghosts));
  return std::make_shared<const algebra::Layout>(std::move(nodes));
}

Matrix6 some_block(GlobalIndex seed) {
  Matrix6 block;
  for (int i = 0; i < 36; ++i)
    block(i / 6, i % 6) = std::sin(static_cast<double>(1 + i) * static_cast<double>(seed + 2));
  return block;
}

/// Every third node equals a mean of the two before it.
Map means(const algebra::Layout& layout) {
  std::vector<Row> rows;
  for (LocalIndex i = 0; i < layout.local_size(); ++i) {
    const GlobalIndex node = layout.global(i);
    if (node % 3 != 2) continue;
    rows.push_back(
        {i, {{.node = layout.local(node - 1), .weight = 0.25}, {.node = layout.local(node - 2), .weight = 0.75}}});
  }
  return {std::move(rows), layout.comm};
}

/// Nodes 0, 3, 6, ... depend on themselves and on the node of the same kind on the next rank, by blocks.
Map chains(const algebra::Layout& layout) {
  std::vector<Row> rows;
  for (LocalIndex i = 0; i < layout.local_size(); ++i) {
    const GlobalIndex node = layout.global(i);
    if (node % 3 != 0) continue;
    const LocalIndex other = layout.local((node + per_rank) % layout.global_size);
    rows.push_back({i, {term(i, some_block(node)), term(other, some_block(node + 7))}});
  }
  return {std::move(rows), layout.comm};
}

algebra::Vector random_vector(std::shared_ptr<const algebra::Layout> layout, int block, std::uint64_t seed) {
  algebra::Vector v(std::move(layout), block);
  algebra::fill_with_pseudo_random_values(v, seed);
  v.update_ghosts();
  return v;
}

double largest_difference(const algebra::Vector& a, const algebra::Vector& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.local().size(); ++i) most = std::max(most, std::abs(a.local()[i] - b.local()[i]));
  return algebra::max_over_ranks(most, a.layout()->comm);
}

Vector6 six(const algebra::Vector& v, LocalIndex node) {
  return Eigen::Map<const Vector6>(v.at(static_cast<std::size_t>(node)).data());
}

TEST(Map, WithoutRowsIsTheIdentity) {
  const auto layout = ring();
  const Map map;
  EXPECT_TRUE(map.is_identity());
  algebra::Vector v = random_vector(layout, 3, 1);
  const algebra::Vector before = v;
  map.apply(v);
  map.apply_transposed(v);
  EXPECT_EQ(largest_difference(v, before), 0);
}

TEST(Map, WeighsAnyNumberOfValues) {
  const auto layout = ring();
  const Map map = means(*layout);
  for (const int block : {1, 4, 6}) {
    algebra::Vector v = random_vector(layout, block, 2);
    const algebra::Vector w = v;
    map.apply(v);
    for (LocalIndex i = 0; i < layout->local_size(); ++i) {
      const GlobalIndex node = layout->global(i);
      EXPECT_EQ(map.constrains(static_cast<std::size_t>(i)), node % 3 == 2);
      for (std::size_t c = 0; c < static_cast<std::size_t>(block); ++c) {
        const auto value = [&](GlobalIndex k) { return w.at(static_cast<std::size_t>(layout->local(k)))[c]; };
        EXPECT_NEAR(v.at(static_cast<std::size_t>(i))[c],
                    node % 3 == 2 ? 0.25 * value(node - 1) + 0.75 * value(node - 2) : value(node), 1e-15);
      }
    }
  }
}

TEST(Map, TakesUnknownsAlsoOfConstrainedNodes) {
  const auto layout = ring();
  const Map map = chains(*layout);
  algebra::Vector v = random_vector(layout, 6, 3);
  const algebra::Vector w = v;
  map.apply(v);
  for (LocalIndex i = 0; i < layout->local_size(); ++i) {
    const GlobalIndex node = layout->global(i);
    if (node % 3 != 0) continue;
    const LocalIndex other = layout->local((node + per_rank) % layout->global_size);
    const Vector6 expected = some_block(node) * six(w, i) + some_block(node + 7) * six(w, other);
    EXPECT_LT((six(v, i) - expected).norm(), 1e-14);
    const Matrix6 own = other == i ? Matrix6(some_block(node) + some_block(node + 7)) : some_block(node);
    EXPECT_LT((map.find(static_cast<std::size_t>(i))->own() - own).norm(), 1e-15);
  }
}

TEST(Map, HasItsTranspose) {
  const auto layout = ring();
  for (const Map& map : {means(*layout), chains(*layout), compose(means(*layout), chains(*layout), layout->comm)}) {
    algebra::Vector w = random_vector(layout, 6, 4), f = random_vector(layout, 6, 5), v = w, on_w = f;
    map.apply(v);
    map.apply_transposed(on_w);
    EXPECT_NEAR(algebra::dot(f, v), algebra::dot(on_w, w), 1e-13 * algebra::norm(f) * algebra::norm(v));
  }
}

TEST(Map, ComposesToOneMapWithoutRowsOfRows) {
  const auto layout = ring();
  const Map outer = means(*layout), inner = chains(*layout), both = compose(outer, inner, layout->comm);
  algebra::Vector one_by_one = random_vector(layout, 6, 6), at_once = one_by_one;
  inner.apply(one_by_one);
  outer.apply(one_by_one);
  both.apply(at_once);
  EXPECT_LT(largest_difference(one_by_one, at_once), 1e-14);
  for (const Row& row : both.rows())
    for (const Term& term : row.terms) EXPECT_NE(layout->global(term.node) % 3, 2);
}

TEST(Map, TransformsMatricesOfElements) {
  const auto layout = ring();
  const Map map = compose(means(*layout), chains(*layout), layout->comm);
  const std::vector<LocalIndex> nodes{0, 2, 4, 5};
  RowMatrix matrix(2, 6 * static_cast<Eigen::Index>(nodes.size()));
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix(i / matrix.cols(), i % matrix.cols()) = std::cos(7.0 * static_cast<double>(i));
  const NodeColumns on_sources = map.on_sources(nodes, matrix);
  EXPECT_EQ(on_sources.nodes, map.sources(nodes));
  algebra::Vector v = random_vector(layout, 6, 7);
  const algebra::Vector w = v;
  map.apply(v);
  const auto product = [](const RowMatrix& m, const std::vector<LocalIndex>& at, const algebra::Vector& values) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(m.rows());
    for (std::size_t i = 0; i < at.size(); ++i)
      sum += m.middleCols<6>(6 * static_cast<Eigen::Index>(i)) * six(values, at[i]);
    return sum;
  };
  EXPECT_LT((product(matrix, nodes, v) - product(on_sources.matrix, on_sources.nodes, w)).norm(), 1e-13);
  const algebra::Connectivity couplings = map.couplings({.nodes_per_element = 4, .nodes = nodes});
  ASSERT_EQ(couplings.elements(), 1U);
  EXPECT_TRUE(std::ranges::equal(couplings.element(0), on_sources.nodes));
}

TEST(Map, KeepsElementsOfFreeNodes) {
  const auto layout = ring();
  const Map map = means(*layout);
  const std::vector<LocalIndex> nodes{0, 1, 3};
  const RowMatrix matrix = RowMatrix::Identity(3, 3);
  const NodeColumns same = map.on_sources(nodes, matrix);
  EXPECT_EQ(same.nodes, nodes);
  EXPECT_EQ(same.matrix, matrix);
}

TEST(Map, IsTheSameAfterTheLayoutGotMoreGhosts) {
  const auto few = ring(false), all = ring();
  Map map = means(*few);
  map.renumber(*few, *all);
  for (const Row& row : map.rows()) {
    const GlobalIndex node = all->global(row.node);
    EXPECT_EQ(node % 3, 2);
    EXPECT_EQ(all->global(row.terms[0].node), node - 1);
    EXPECT_EQ(map.find(static_cast<std::size_t>(row.node)), &row);
  }
}

}  // namespace
}  // namespace plastron::constraints
