#include <plastron/algebra/matrix.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "algebra/chain.hpp"

namespace plastron::test {
namespace {

constexpr GlobalIndex nodes = 17;
constexpr int block = 2;
constexpr std::size_t size = nodes * block;

// Triangles that reach far across ranks. Their rank does not see all elements of its own nodes.
Elements example_elements() {
  Elements elements;
  for (GlobalIndex i = 0; i + 1 < nodes; ++i) elements.push_back({i, i + 1, (7 * i + 3) % nodes});
  return elements;
}

// A symmetric element matrix that depends on the element's number only.
std::vector<double> element_matrix(std::size_t number, std::size_t width) {
  std::mt19937 random(static_cast<unsigned>(number) + 1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> values(width * width);
  for (std::size_t i = 0; i < width; ++i)
    for (std::size_t j = 0; j <= i; ++j) values[i * width + j] = values[j * width + i] = uniform(random);
  return values;
}

Matrix assemble(const std::shared_ptr<const Layout>& layout, const Elements& elements) {
  Matrix A(layout, block, connectivity(*layout, elements));
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (layout->owns(elements[e].front()))
      A.add(local_nodes(*layout, elements[e]), element_matrix(e, elements[e].size() * block));
  A.finish();
  return A;
}

std::vector<double> dense(const Elements& elements) {
  std::vector<double> A(size * size, 0.0);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::size_t width = elements[e].size() * block;
    const auto values = element_matrix(e, width);
    const auto unknown = [&](std::size_t i) {
      return static_cast<std::size_t>(elements[e][i / block]) * block + i % block;
    };
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t j = 0; j < width; ++j) A[unknown(i) * size + unknown(j)] += values[i * width + j];
  }
  return A;
}

double wave(GlobalIndex i) { return std::sin(1.0 + 3.0 * static_cast<double>(i)); }

TEST(Matrix, multiplies_like_the_dense_one) {
  const auto elements = example_elements();
  const auto layout = layout_for(nodes, elements);
  const Matrix A = assemble(layout, elements);
  const auto D = dense(elements);
  const Vector x = vector_of(layout, block, wave);
  Vector y(layout, block);
  Vector bound(layout, block);
  A.multiply(x, y);
  A.multiply_absolute(x, bound);
  const auto product = gather(y);
  const auto absolute = gather(bound);
  for (std::size_t i = 0; i < size; ++i) {
    double expected = 0;
    double expected_absolute = 0;
    for (std::size_t j = 0; j < size; ++j) {
      expected += D[i * size + j] * wave(static_cast<GlobalIndex>(j));
      expected_absolute += std::abs(D[i * size + j] * wave(static_cast<GlobalIndex>(j)));
    }
    EXPECT_NEAR(product[i], expected, 1e-13);
    EXPECT_NEAR(absolute[i], expected_absolute, 1e-13);
  }
}

TEST(Matrix, knows_its_diagonal_and_the_size_of_its_pattern) {
  const auto elements = example_elements();
  const Matrix A = assemble(layout_for(nodes, elements), elements);
  const auto D = dense(elements);
  const auto diagonal = gather(A.diagonal());
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(diagonal[i], D[i * size + i], 1e-14);
  std::set<std::pair<GlobalIndex, GlobalIndex>> couplings;
  for (const auto& element : elements)
    for (const GlobalIndex p : element)
      for (const GlobalIndex q : element) couplings.emplace(p, q);
  EXPECT_EQ(A.nonzeros(), static_cast<std::int64_t>(couplings.size()) * block * block);
}

TEST(Matrix, can_be_filled_again_and_adds_up) {
  const auto elements = example_elements();
  const auto layout = layout_for(nodes, elements);
  Matrix A = assemble(layout, elements);
  A.set_zero();
  for (int round = 0; round < 2; ++round) {
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (layout->owns(elements[e].front()))
        A.add(local_nodes(*layout, elements[e]), element_matrix(e, elements[e].size() * block));
    A.finish();
  }
  const auto twice = gather(A.diagonal());
  const auto once = gather(assemble(layout, elements).diagonal());
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(twice[i], 2 * once[i], 1e-14);
}

TEST(Matrix, takes_an_element_that_names_a_node_twice) {
  const auto elements = chain(nodes);
  const auto layout = layout_for(nodes, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  if (layout->owned > 0) A.add(std::vector<LocalIndex>{0, 0}, std::vector<double>{1, 2, 2, 5});
  A.finish();
  EXPECT_EQ(gather(A.diagonal())[static_cast<std::size_t>(layout->first)], 10);
}

TEST(Matrix, refuses_what_its_pattern_does_not_hold) {
  const auto elements = chain(nodes);
  const auto layout = layout_for(nodes, elements);
  Matrix A(layout, 1, connectivity(*layout, elements));
  const std::vector<double> values(4, 1.0);
  EXPECT_THROW(A.add(std::vector<LocalIndex>{0, 3}, values), std::out_of_range);
  EXPECT_THROW(A.add(std::vector<LocalIndex>{0, -1}, values), std::out_of_range);
  EXPECT_THROW(A.add(std::vector<LocalIndex>{0, layout->local_size()}, values), std::out_of_range);
  EXPECT_THROW(A.add(std::vector<LocalIndex>{0, 1, 2}, values), std::invalid_argument);
}

}  // namespace
}  // namespace plastron::test
