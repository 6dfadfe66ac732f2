// Metres or micrometres, newtons or meganewtons: every study and the comparison find the same.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <research/study/kinds.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "computation/units.hpp"
#include "research/tables.hpp"

namespace plastron::study::study_units_test {
namespace {

using namespace test;

/// The scale of a quantity in `unit`; NaN for seconds, which always differ, and for columns with quantities of several kinds.
double scale_of(const std::string& unit, const Units& u) {
  const double work = u.force * u.length;
  const std::map<std::string, double> scales{
      {"1", 1},      {"%", 1},    {"m", u.length},   {"m^2", u.length * u.length}, {"N", u.force},
      {"N m", work}, {"J", work}, {"1/J", 1 / work}, {"J^{1/2}", std::sqrt(work)}, {"s", NAN},
      {"-", NAN}};
  const auto found = scales.find(unit);
  if (found != scales.end()) return found->second;
  ADD_FAILURE() << "no scale of " << unit;
  return NAN;
}

/// Up to 1e-6, and to 1e-8 of the column's largest value, because small values are differences of large ones.
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

/// Computed once.
const Report& in_plain_units(const Kind& kind) {
  static std::map<std::string, Report> known;
  const std::string name(kind.name);
  if (!known.contains(name)) known.emplace(name, kind.run(panel({}), few_samples(), MPI_COMM_SELF, {}));
  return known.at(name);
}

/// Two systems with other units of length and force, and other moduli. units_test.cc tests more units with a single computation.
class EveryStudy : public testing::TestWithParam<Units> {};
INSTANTIATE_TEST_SUITE_P(Of, EveryStudy, testing::Values(Units{1e-6, 1e3}, Units{1e6, 1e-4}),
                         [](const auto& units) { return fmt::format("{}", units.index); });

TEST_P(EveryStudy, FindsTheSameInAllUnits) {
  std::vector<const Kind*> all{&comparison()};
  for (const Kind& kind : kinds()) all.push_back(&kind);
  for (const Kind* kind : all) {
    SCOPED_TRACE(kind->name);
    const Report report = kind->run(panel(GetParam()), few_samples(), MPI_COMM_SELF, {});
    const Report& plain = in_plain_units(*kind);
    ASSERT_EQ(report.status, contact::Status::solved);
    // Rounding decides how small a p can be computed.
    const std::size_t rows = kind->name == "penalty" ? 4 : plain.table.rows.size();
    expect_like(report.table, plain.table, GetParam(), rows);
    ASSERT_EQ(report.table.claims.size(), plain.table.claims.size());
    for (std::size_t i = 0; i < plain.table.claims.size(); ++i)
      EXPECT_EQ(report.table.claims[i].verdict, plain.table.claims[i].verdict)
          << report.table.claims[i].statement << ": " << report.table.claims[i].measured
          << report.table.claims[i].reason;
  }
}

// A cap 5 mm in radius, in metres.
TEST(ASmallCap, InMetresHasItsSoftModes) {
  problem::Problem p = with_chart(free_plate(), {"x", "y", "R - sqrt(R^2 - x^2 - y^2)"}, {{"R", 0.005}});
  p.domain = domain::Disk{.radius = 0.0024};
  p.shell.sections.common.thickness = Expression(2.5e-4);
  p.shell.sections.common.material = shell::Material::from_young_poisson(2.1e11, 0.3, 1);
  p.discretisation = {.degree = 2, .refinements = 3};
  const Table table = find_kind("soft-modes")->run(p, {}, MPI_COMM_SELF, {}).table;
  for (const std::string formulation : {"tangent", "penalised", "mixed", "classical"})
    EXPECT_EQ(claim_on(table, formulation + ": the soft modes are").verdict, Verdict::holds) << formulation;
}

}  // namespace
}  // namespace plastron::study::study_units_test
