// Metres or micrometres, newtons or meganewtons: the examination and the solution are the same.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>

#include <cmath>

#include "computation/units.hpp"

namespace plastron::computation {
namespace {

using namespace test;

/// Each alone and together. Lengths with forces that keep the modulus have the form {s, s^2}.
class EveryUnit : public testing::TestWithParam<Units> {};
INSTANTIATE_TEST_SUITE_P(Of, EveryUnit,
                         testing::Values(Units{1e-6, 1}, Units{1e6, 1}, Units{1, 1e-6}, Units{1, 1e6},
                                         Units{1e-6, 1e-12}, Units{1e6, 1e12}, Units{1e-6, 1e6}, Units{1e6, 1e-6},
                                         Units{1e-6, 1e-6}, Units{1e6, 1e6}),
                         [](const auto& units) { return fmt::format("{}", units.index); });

TEST_P(EveryUnit, IsExaminedAlike) {
  const auto findings = examination::examine(panel(GetParam())), plain = examination::examine(panel({}));
  ASSERT_EQ(findings.size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(findings[i].severity, plain[i].severity) << findings[i].text;
}

TEST_P(EveryUnit, HasTheSameSolution) {
  const auto [length, force] = GetParam();
  const Result found = solve(panel(GetParam()), MPI_COMM_SELF), plain = solve(panel({}), MPI_COMM_SELF);
  ASSERT_EQ(found.status, contact::Status::solved);
  ASSERT_GT(plain.summary.touching_nodes, 0);
  EXPECT_EQ(found.summary.touching_nodes, plain.summary.touching_nodes);
  const auto same = [](double value, double expected) { EXPECT_NEAR(value, expected, 1e-6 * std::abs(expected)); };
  same(found.summary.energy.total() / (length * force), plain.summary.energy.total());
  same(found.summary.reaction.force[2] / force, plain.summary.reaction.force[2]);
  same(found.summary.contact_area / (length * length), plain.summary.contact_area);
  same(found.summary.max_pressure * length * length / force, plain.summary.max_pressure);
  same(found.probes[0].values.u[2] / length, plain.probes[0].values.u[2]);
  same(found.probes[0].values.r[0], plain.probes[0].values.r[0]);
  EXPECT_LT(found.certificate.stationarity, 1e-8);
  EXPECT_LT(found.certificate.energy_identity, 1e-8);
  for (std::size_t l = 0; l < plain.levels.size(); ++l)
    EXPECT_EQ(found.levels[l].iterations, plain.levels[l].iterations);
}

}  // namespace
}  // namespace plastron::computation
