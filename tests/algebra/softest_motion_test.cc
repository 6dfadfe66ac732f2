#include <plastron/algebra/softest_motion.hpp>

#include <gtest/gtest.h>

#include "algebra/beam.hpp"

namespace plastron::test {
namespace {

// Pinning one node of a beam leaves it free to rotate; rounding alone decides whether the factorisation notices.
TEST(SoftestMotion, is_free_for_a_beam_that_can_rotate) {
  for (const GlobalIndex nodes : {11, 20, 57, 200, 999}) {
    const Beam beam(nodes, 1.0 / 3);
    const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
    std::vector<char> fixed = beam.ends(1);
    if (rank() == ranks() - 1) fixed.back() = 0;
    algebra::Factorisation F(beam.matrix);
    if (!F.factorise(fixed)) continue;
    const auto softest = algebra::softest_motion(apply, F, fixed, beam.matrix.diagonal());
    EXPECT_TRUE(softest.is_free()) << softest.stiffness << " " << softest.factor_stiffness;
  }
}

// Springs of the size of rounding times a thousand let every factorisation through; the operator does not know them.
TEST(SoftestMotion, is_free_where_the_factor_alone_holds_the_beam) {
  for (const GlobalIndex nodes : {11, 57, 200}) {
    Beam beam(nodes);
    const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
    for (LocalIndex i = 0; i < beam.layout->owned; ++i)
      beam.matrix.add(std::vector<LocalIndex>{i}, std::vector<double>{1e-12});
    beam.matrix.finish();
    std::vector<char> fixed = beam.ends(1);
    if (rank() == ranks() - 1) fixed.back() = 0;
    algebra::Factorisation F(beam.matrix);
    ASSERT_TRUE(F.factorise(fixed)) << nodes;
    const auto softest = algebra::softest_motion(apply, F, fixed, beam.matrix.diagonal());
    EXPECT_TRUE(softest.is_free()) << softest.stiffness << " " << softest.factor_stiffness;
    EXPECT_GT(softest.factor_stiffness, 0);
  }
}

TEST(SoftestMotion, is_not_free_for_a_slender_beam_that_is_held) {
  for (const GlobalIndex nodes : {11, 200, 3000}) {
    const Beam beam(nodes);
    const auto apply = [&](const Vector& z, Vector& y) { beam.apply(z, y); };
    const auto fixed = beam.ends(1);
    algebra::Factorisation F(beam.matrix);
    ASSERT_TRUE(F.factorise(fixed));
    const auto softest = algebra::softest_motion(apply, F, fixed, beam.matrix.diagonal());
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
  EXPECT_FALSE(algebra::softest_motion(apply, F, fixed, beam.matrix.diagonal()).is_free());
}

}  // namespace
}  // namespace plastron::test
