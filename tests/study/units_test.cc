// Metres or micrometres, newtons or meganewtons: every command finds the same.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <plastron/study/examine.hpp>
#include <plastron/study/kinds.hpp>
#include <plastron/study/solve.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "study/problems.hpp"
#include "study/tables.hpp"

namespace plastron::study {
namespace {

/// What the numbers of all lengths and of all forces are multiplied by; a modulus then by force / length^2.
struct Units {
  double length = 1, force = 1;
};

/// A small curved panel above a table, held at two sides and pressed on it by a pressure, a line load and a couple.
Problem panel(const Units& units) {
  const double L = units.length, F = units.force, pressure = F / (L * L);
  Problem p = with_chart(free_plate(), {"x", "y", "0.02*L + e/2 + 0.2*x^2/L"}, {{"L", L}, {"e", 0.1 * L}});
  p.domain = fem::Rectangle{.to = {L, L}, .cells = {2, 2}};
  p.thickness = Expression(0.1 * L);
  p.material = shell::Material::from_young_poisson(1e4 * pressure, 0.3, 1);
  p.supports = {clamped("left"), held("right", {Direction::x, Direction::y, Direction::z})};
  p.area_loads = {force(0, 0, -60 * pressure)};
  p.edge_loads = {{.boundary = "top", .force = vector(0, 0, -3 * F / L), .couple = vector(0.1 * F, 0, 0)}};
  p.obstacle = Obstacle{};
  p.probes = {{.name = "middle", .at = {0.5 * L, 0.4 * L}}};
  p.discretisation = {.degree = 2, .refinements = 1};
  return p;
}

StudyOptions few() {
  StudyOptions options;
  options.reference = 1;
  options.samples = 2;
  options.factors = {1, 0.5};
  return options;
}

/// Each alone and together. Lengths with forces that leave the modulus as it is are those of {s, s^2}.
class EveryUnit : public testing::TestWithParam<Units> {};
INSTANTIATE_TEST_SUITE_P(Of, EveryUnit,
                         testing::Values(Units{1e-6, 1}, Units{1e6, 1}, Units{1, 1e-6}, Units{1, 1e6},
                                         Units{1e-6, 1e-12}, Units{1e6, 1e12}, Units{1e-6, 1e6}, Units{1e6, 1e-6},
                                         Units{1e-6, 1e-6}, Units{1e6, 1e6}),
                         [](const auto& units) { return fmt::format("{}", units.index); });

/// Of a quantity in `unit`; NaN for seconds, which are never the same.
double scale_of(const std::string& unit, const Units& u) {
  const double work = u.force * u.length;
  const std::map<std::string, double> scales{
      {"1", 1},      {"%", 1},    {"m", u.length},   {"m^2", u.length * u.length}, {"N", u.force},
      {"N m", work}, {"J", work}, {"1/J", 1 / work}, {"J^{1/2}", std::sqrt(work)}, {"s", NAN}};
  const auto found = scales.find(unit);
  if (found != scales.end()) return found->second;
  ADD_FAILURE() << "no scale of " << unit;
  return NAN;
}

/// Up to 1e-6, and to 1e-8 of the column's largest value, where small values are differences of large ones.
void expect_like(const Table& table, const Table& plain, const Units& units, std::size_t rows) {
  ASSERT_GE(table.rows.size(), rows);
  ASSERT_GE(plain.rows.size(), rows);
  for (std::size_t c = 0; c < plain.columns.size(); ++c) {
    const Column& column = plain.columns[c];
    double largest = column.unit == "1" ? 1 : 0;
    for (const auto& row : plain.rows)
      if (const double* value = std::get_if<double>(&row[c]); value && std::isfinite(*value))
        largest = std::max(largest, std::abs(*value));
    for (std::size_t r = 0; r < rows; ++r) {
      const Entry &a = table.rows[r][c], &b = plain.rows[r][c];
      ASSERT_EQ(a.index(), b.index());
      if (!std::holds_alternative<double>(b)) {
        EXPECT_EQ(a, b) << column.name << " in row " << r;
        continue;
      }
      const double scale = scale_of(column.unit, units), expected = std::get<double>(b),
                   found = std::get<double>(a) / scale;
      if (std::isnan(scale)) continue;
      EXPECT_EQ(std::isnan(found), std::isnan(expected)) << column.name << " in row " << r;
      if (std::isnan(expected)) continue;
      EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected) + 1e-8 * largest) << column.name << " in row " << r;
    }
  }
}

TEST_P(EveryUnit, IsExaminedAlike) {
  const auto findings = examine(panel(GetParam())), plain = examine(panel({}));
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

TEST_P(EveryUnit, FindsTheSameInEveryStudy) {
  std::vector<const Kind*> all{&comparison()};
  for (const Kind& kind : kinds()) all.push_back(&kind);
  for (const Kind* kind : all) {
    SCOPED_TRACE(kind->name);
    const Report report = kind->run(panel(GetParam()), few(), MPI_COMM_SELF, {}),
                 plain = kind->run(panel({}), few(), MPI_COMM_SELF, {});
    ASSERT_EQ(report.status, contact::Status::solved);
    // How small a p can be computed is for rounding to say.
    const std::size_t rows = kind->name == "penalty" ? 4 : plain.table.rows.size();
    expect_like(report.table, plain.table, GetParam(), rows);
    ASSERT_EQ(report.table.claims.size(), plain.table.claims.size());
    for (std::size_t i = 0; i < plain.table.claims.size(); ++i)
      EXPECT_EQ(report.table.claims[i].verdict, plain.table.claims[i].verdict)
          << report.table.claims[i].statement << ": " << report.table.claims[i].measured
          << report.table.claims[i].reason;
  }
}

// The case that asked for it: 5 mm across, in metres.
TEST(ASmallCap, InMetresHasItsSoftModes) {
  Problem p = with_chart(free_plate(), {"x", "y", "0.01 - sqrt(0.0001 - x^2 - y^2)"});
  p.domain = fem::Disk{.radius = 0.0025};
  p.thickness = Expression(5e-5);
  p.material = shell::Material::from_young_poisson(2.1e11, 0.3, 1);
  p.discretisation = {.degree = 2, .refinements = 2};
  const Table table = find_kind("soft-modes")->run(p, {}, MPI_COMM_SELF, {}).table;
  for (const std::string formulation : {"tangent", "penalised", "mixed", "classical"})
    EXPECT_EQ(claim_on(table, formulation + ": the soft modes are").verdict, Verdict::holds) << formulation;
}

}  // namespace
}  // namespace plastron::study
