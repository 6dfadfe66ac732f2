#include <plastron/algebra/factorisation.hpp>
#include <plastron/algebra/krylov.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "algebra/beam.hpp"

namespace plastron::test {
namespace {

using algebra::CgResult;
using algebra::conjugate_gradients;
using algebra::Factorisation;
using algebra::Operator;

Operator operator_of(const Beam& beam) {
  return [&beam](const Vector& z, Vector& y) { beam.apply(z, y); };
}

Operator solver_of(const Factorisation& F) {
  return [&F](const Vector& r, Vector& z) { F.solve(r, z); };
}

// The largest error of z against the exact polynomial deflection, relative.
double error_of(const Vector& z, const Vector& exact) {
  Vector difference = z;
  algebra::axpy(-1, exact, difference);
  return algebra::max_abs(difference) / algebra::max_abs(exact);
}

TEST(ConjugateGradients, with_a_perturbed_factor_reach_a_residual_far_below_the_plain_solve) {
  const Beam beam(60);
  const Beam perturbed(60, 0.05);
  const auto fixed = beam.ends(2);
  Factorisation F(perturbed.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  const auto b = vector_of(beam.layout, 1, [](GlobalIndex i) { return std::sin(static_cast<double>(i)); });
  const Vector diagonal = beam.matrix.diagonal();
  Vector x(beam.layout, 1);
  const auto one_step = conjugate_gradients(operator_of(beam), solver_of(F), b, fixed, diagonal, x, {.max_steps = 0});
  EXPECT_EQ(one_step.relative_residual, 1);
  const auto result = conjugate_gradients(operator_of(beam), solver_of(F), b, fixed, diagonal, x);
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.steps, 5);
  EXPECT_LT(result.relative_residual, 1e-11);
}

// A solution that is a polynomial of degree 2 has constant curvature: A z is zero inside and exact in double precision.
TEST(ConjugateGradients, are_as_accurate_as_the_operator_where_the_matrix_is_hopelessly_ill_conditioned) {
  const GlobalIndex nodes = 3000;
  const Beam beam(nodes, 1e-9);
  const Beam exact_beam(nodes);
  const auto fixed = beam.ends(2);
  const auto exact = vector_of(beam.layout, 1, [&](GlobalIndex i) {
    const double s = static_cast<double>(i) / static_cast<double>(nodes);
    return s * s * (1 - s) * (1 - s);
  });
  Vector b(beam.layout, 1);
  exact_beam.apply(exact, b);
  Vector x(beam.layout, 1);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) x.owned()[i] = exact.owned()[i];
  Factorisation F(beam.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  const auto result = conjugate_gradients(operator_of(exact_beam), solver_of(F), b, fixed, beam.matrix.diagonal(), x);
  EXPECT_LT(result.relative_residual, 1e-7);
  EXPECT_LT(error_of(x, exact), 1e-8);
}

TEST(ConjugateGradients, leave_fixed_unknowns_alone) {
  const Beam beam(30);
  const auto fixed = beam.ends(2);
  Factorisation F(beam.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  Vector x = vector_of(beam.layout, 1, [](GlobalIndex i) { return 3.0 + 0.5 * static_cast<double>(i); });
  const Vector line = x;
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!fixed[i]) x.owned()[i] = 0;
  const Vector nothing(beam.layout, 1);
  const auto result = conjugate_gradients(operator_of(beam), solver_of(F), nothing, fixed, beam.matrix.diagonal(), x);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(error_of(x, line), 1e-12);
}

TEST(ConjugateGradients, measure_the_residual_against_the_free_unknowns_being_zero_wherever_they_start) {
  const Beam beam(30);
  const auto fixed = beam.ends(2);
  Factorisation F(beam.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  const auto b = vector_of(beam.layout, 1, [](GlobalIndex) { return 1.0; });
  Vector x(beam.layout, 1);
  const Vector diagonal = beam.matrix.diagonal();
  conjugate_gradients(operator_of(beam), solver_of(F), b, fixed, diagonal, x);
  const CgResult again = conjugate_gradients(operator_of(beam), solver_of(F), b, fixed, diagonal, x);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.steps, 0);
  EXPECT_LT(again.relative_residual, 1e-12);
}

TEST(ConjugateGradients, give_up_on_a_tolerance_below_rounding_and_return_their_best) {
  const Beam beam(400);
  const auto fixed = beam.ends(2);
  Factorisation F(beam.matrix);
  ASSERT_TRUE(F.factorise(fixed));
  const auto b = vector_of(beam.layout, 1, [](GlobalIndex i) { return std::cos(static_cast<double>(i)); });
  Vector x(beam.layout, 1);
  const auto result =
      conjugate_gradients(operator_of(beam), solver_of(F), b, fixed, Vector(), x, {.tolerance = 0, .max_steps = 100});
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.steps, 20);
  EXPECT_LT(result.relative_residual, 1e-9);
}

TEST(ConjugateGradients, are_done_at_once_without_a_load) {
  const Beam beam(12);
  Factorisation F(beam.matrix);
  const auto fixed = beam.ends(1);
  ASSERT_TRUE(F.factorise(fixed));
  Vector x(beam.layout, 1);
  const auto result = conjugate_gradients(operator_of(beam), solver_of(F), Vector(x), fixed, beam.matrix.diagonal(), x);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(result.relative_residual, 0);
}

}  // namespace
}  // namespace plastron::test
