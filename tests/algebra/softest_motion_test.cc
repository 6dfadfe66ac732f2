#include <plastron/algebra/factorisation.hpp>

#include <gtest/gtest.h>

#include "algebra/beam.hpp"

namespace plastron::test {
namespace {

// Fixing one node of a beam leaves it free to rotate. Springs as weak as rounding make the factorisation go through: the
// operator alone knows that the rotation costs nothing.
TEST(SoftestMotion, is_free_for_a_beam_that_can_rotate_though_its_matrix_was_factorised) {
  for (const GlobalIndex nodes : {11, 20, 57, 200, 999}) {
    const Beam beam(nodes, 1.0 / 3, MPI_COMM_WORLD, 1e-12);
    const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
    std::vector<char> fixed = beam.ends(1);
    if (rank() == ranks() - 1) fixed.back() = 0;
    algebra::Factorisation F(beam.matrix);
    ASSERT_TRUE(F.factorise(fixed)) << nodes;
    const auto softest = F.softest_motion(apply, fixed, beam.matrix.diagonal());
    EXPECT_TRUE(softest.is_free()) << softest.stiffness << " " << softest.factor_stiffness;
  }
}

TEST(SoftestMotion, is_not_free_for_a_slender_beam_that_is_held) {
  for (const GlobalIndex nodes : {11, 200, 3000}) {
    const Beam beam(nodes);
    const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
    const auto fixed = beam.ends(1);
    algebra::Factorisation F(beam.matrix);
    ASSERT_TRUE(F.factorise(fixed));
    const auto softest = F.softest_motion(apply, fixed, beam.matrix.diagonal());
    EXPECT_FALSE(softest.is_free()) << softest.stiffness << " " << softest.factor_stiffness;
    EXPECT_NEAR(softest.stiffness / softest.factor_stiffness, 1, 0.2);
  }
}

TEST(SoftestMotion, is_none_where_everything_is_fixed) {
  const Beam beam(10);
  const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
  const std::vector<char> fixed(static_cast<std::size_t>(beam.layout->owned), 1);
  algebra::Factorisation F(beam.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  EXPECT_FALSE(F.softest_motion(apply, fixed, beam.matrix.diagonal()).is_free());
}

}  // namespace
}  // namespace plastron::test
