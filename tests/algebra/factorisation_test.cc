#include <plastron/algebra/factorisation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

using algebra::Factorisation;

constexpr GlobalIndex nodes = 40;
constexpr int block = 3;

Elements ladder() {
  Elements elements;
  for (GlobalIndex i = 0; i + 1 < nodes; ++i) elements.push_back({i, i + 1, (11 * i + 5) % nodes});
  return elements;
}

// Element matrices G G' + shift I; positive definite for shift > 0.
Matrix ladder_matrix(double shift) {
  const auto elements = ladder();
  const auto layout = layout_for(nodes, elements);
  Matrix A(layout, block, connectivity(*layout, elements));
  constexpr std::size_t width = 3 * block;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!layout->owns(elements[e].front())) continue;
    std::vector<double> values(width * width, 0.0);
    const auto g = [&](std::size_t i, std::size_t k) {
      return std::sin(static_cast<double>(1 + e + 5 * i + 3 * i * k));
    };
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t j = 0; j < width; ++j) {
        for (std::size_t k = 0; k < 4; ++k) values[i * width + j] += g(i, k) * g(j, k);
        if (i == j) values[i * width + j] += shift;
      }
    A.add(local_nodes(*layout, elements[e]), values);
  }
  A.finish();
  return A;
}

std::vector<char> fix_every(const Layout& layout, GlobalIndex period) {
  std::vector<char> fixed(static_cast<std::size_t>(layout.owned * block), 0);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    fixed[i] = period > 0 && (layout.first * block + static_cast<GlobalIndex>(i)) % period == 0;
  return fixed;
}

void expect_solves(const Matrix& A, const Factorisation& F, const std::vector<char>& fixed) {
  const auto b = vector_of(A.layout(), block, [](GlobalIndex i) { return std::cos(static_cast<double>(i)); });
  const auto d = A.diagonal();
  Vector x(A.layout(), block);
  F.solve(b, x);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) {
      EXPECT_NEAR(x.owned()[i], b.owned()[i] / d.owned()[i], 1e-14);
      x.owned()[i] = 0;
    }
  Vector Ax(A.layout(), block);
  A.multiply(x, Ax);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) {
      EXPECT_NEAR(Ax.owned()[i], b.owned()[i], 1e-11);
    }
}

TEST(Factorisation, solves_on_the_unknowns_that_are_not_fixed_and_divides_by_the_diagonal_on_the_others) {
  const Matrix A = ladder_matrix(0.1);
  Factorisation F(A);
  for (const GlobalIndex period : {0, 2, 7, 1}) {
    const auto fixed = fix_every(*A.layout(), period);
    ASSERT_TRUE(F.factorise(fixed));
    expect_solves(A, F, fixed);
  }
}

TEST(Factorisation, analyses_once_and_factorises_many_times) {
  const Matrix A = ladder_matrix(0.1);
  Factorisation F(A);
  const double analysis = F.seconds_symbolic();
  for (int count = 1; count <= 3; ++count) {
    ASSERT_TRUE(F.factorise(fix_every(*A.layout(), 5)));
    EXPECT_EQ(F.factorisations(), count);
  }
  EXPECT_EQ(F.seconds_symbolic(), analysis);
  EXPECT_GT(F.seconds_numeric(), 0);
}

// On one rank movable unknowns, and a few others, are fixed without another factor; several ranks factorise anew. The solutions are the same.
TEST(Factorisation, solves_for_any_fixed_set_when_some_unknowns_are_movable) {
  const Matrix A = ladder_matrix(0.1);
  const auto movable = fix_every(*A.layout(), 3);
  Factorisation F(A, movable);
  for (const GlobalIndex period : {20, 0, 40, 4, 0, 3, 5, 6, 1, 2}) {  // 0 after 20 lets go of four in a border
    const auto fixed = fix_every(*A.layout(), period);
    ASSERT_TRUE(F.factorise(fixed));
    expect_solves(A, F, fixed);
  }
}

TEST(Factorisation, factorises_once_for_all_fixed_sets_of_movable_unknowns_on_one_rank) {
  const Matrix A = ladder_matrix(0.1);
  const auto none = fix_every(*A.layout(), 0);
  EXPECT_TRUE(Factorisation(A).nearest_fixed(none).empty());
  Factorisation F(A, fix_every(*A.layout(), 3));
  EXPECT_TRUE(F.nearest_fixed(none).empty());
  int ranks = 1;
  MPI_Comm_size(A.layout()->comm, &ranks);
  for (const GlobalIndex period : {3, 0, 6, 9, 10}) {  // 10: eight that are not movable, a border
    const auto fixed = fix_every(*A.layout(), period);
    ASSERT_TRUE(F.factorise(fixed));
    expect_solves(A, F, fixed);
    if (ranks == 1) {
      EXPECT_EQ(F.factorisations(), 1);
      EXPECT_EQ(F.nearest_fixed(none), none);
    }
  }
}

// Whatever a border before had: 20 fixes four in the factor, 50 releases three of them and fixes one more, 10 fixes four.
TEST(Factorisation, releases_and_fixes_in_any_succession_with_one_factor) {
  const Matrix A = ladder_matrix(0.1);
  int ranks = 1;
  MPI_Comm_size(A.layout()->comm, &ranks);
  for (const GlobalIndex tail : {3, 120}) {  // 120: one movable unknown
    Factorisation F(A, fix_every(*A.layout(), tail));
    for (const GlobalIndex period : {20, 50, 20, 0, 10, 50, 40, 10, 20}) {
      const auto fixed = fix_every(*A.layout(), period);
      ASSERT_TRUE(F.factorise(fixed));
      expect_solves(A, F, fixed);
    }
    if (ranks == 1) {
      EXPECT_EQ(F.factorisations(), 1);
    }
  }
}

TEST(Factorisation, fixes_movable_unknowns_that_alone_hold_the_structure) {
  const auto elements = chain(9);
  const auto layout = layout_for(9, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  for (const auto& element : elements)  // a row of springs without support
    if (layout->owns(element.front())) A.add(local_nodes(*layout, element), std::vector<double>{1, -1, -1, 1});
  A.finish();
  std::vector<char> first(static_cast<std::size_t>(layout->owned), 0);
  for (LocalIndex i = 0; i < layout->owned; ++i) first[static_cast<std::size_t>(i)] = layout->global(i) == 0;
  Factorisation F(A, first);
  EXPECT_TRUE(F.factorise(first));
}

TEST(Factorisation, tells_a_matrix_that_is_not_positive_definite_and_recovers) {
  const Matrix A = ladder_matrix(-3.0);
  Factorisation F(A);
  EXPECT_FALSE(F.factorise(fix_every(*A.layout(), 0)));
  Vector x(A.layout(), block);
  EXPECT_THROW(F.solve(Vector(x), x), std::logic_error);
  const auto all_fixed = fix_every(*A.layout(), 1);
  ASSERT_TRUE(F.factorise(all_fixed));
  EXPECT_FALSE(F.factorise(fix_every(*A.layout(), 0)));
  ASSERT_TRUE(F.factorise(all_fixed));
}

TEST(Factorisation, tells_a_matrix_that_is_zero_and_recovers) {
  const auto elements = chain(7);
  const auto layout = layout_for(7, elements);
  const Matrix A(layout, 1, connectivity(*layout, elements));
  Factorisation F(A);
  const std::vector<char> none(static_cast<std::size_t>(layout->owned), 0);
  const std::vector<char> all(static_cast<std::size_t>(layout->owned), 1);
  EXPECT_FALSE(F.factorise(none));
  EXPECT_TRUE(F.factorise(all));
  EXPECT_FALSE(F.factorise(none));
  EXPECT_TRUE(F.factorise(all));
}

TEST(Factorisation, gives_a_fixed_unknown_without_stiffness_a_diagonal) {
  const auto elements = chain(6);
  const auto layout = layout_for(6, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  std::vector<char> fixed(static_cast<std::size_t>(layout->owned), 0);
  for (LocalIndex i = 0; i < layout->owned; ++i) {
    const bool empty = layout->global(i) == 2;
    fixed[static_cast<std::size_t>(i)] = empty;
    A.add(std::vector<LocalIndex>{i}, std::vector<double>{empty ? 0.0 : 4.0});
  }
  A.finish();
  Factorisation F(A);
  ASSERT_TRUE(F.factorise(fixed));
  Vector x(layout, 1);
  F.solve(vector_of(layout, 1, [](GlobalIndex) { return 1.0; }), x);
  for (const double value : gather(x)) EXPECT_DOUBLE_EQ(value, 0.25);
}

TEST(Factorisation, wants_one_mark_per_owned_unknown) {
  const Matrix A = ladder_matrix(0.1);
  Factorisation F(A);
  EXPECT_THROW(F.factorise(std::vector<char>(static_cast<std::size_t>(nodes * block + 1), 0)), std::invalid_argument);
}

TEST(Factorisation, can_be_moved) {
  const Matrix A = ladder_matrix(0.1);
  Factorisation F(A);
  const auto fixed = fix_every(*A.layout(), 4);
  ASSERT_TRUE(F.factorise(fixed));
  const Factorisation moved = std::move(F);
  expect_solves(A, moved, fixed);
}

}  // namespace
}  // namespace plastron::test
