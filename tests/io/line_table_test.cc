// line-NAME.csv, read back.
#include <plastron/computation/evaluation.hpp>
#include <plastron/io/csv_tables.hpp>
#include <plastron/workflow/output.hpp>

#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>

#include <sstream>

namespace plastron::io {

namespace {

using workflow::Output;

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(LineTable, has_a_row_a_point_with_every_field) {
  const ScratchDirectory scratch("line");
  problem::Problem problem = pressed_plate({.degree = 2, .refinements = 2});
  problem.probes = {{"half", {0.5, 0.5}}};
  const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
  Output output(scratch.path, "solution", MPI_COMM_WORLD, false, {.heights = {-0.375}});
  output.finish(result, {}, {{"across", {{0.25, 0.5}, {0.5, 0.5}, {1, 0.5}}}});
  std::istringstream text(text_of(scratch.path / "line-across.csv"));
  std::vector<std::vector<std::string>> rows;
  for (std::string row; std::getline(text, row);) rows.push_back(cells_of(row));
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) EXPECT_EQ(row.size(), rows[0].size());
  const auto column = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(rows[0], name) - rows[0].begin());
  };
  const auto number = [&](std::size_t row, const std::string& name) { return std::stod(rows[row].at(column(name))); };
  EXPECT_NEAR(number(2, "s [m]"), 0.5, 1e-14);  // the chart is (2x, y, 0.012)
  EXPECT_NEAR(number(3, "s [m]"), 1.5, 1e-14);
  const recovery::PointValues& p = result.probes.at(0).values;
  EXPECT_NEAR(number(2, "displacement Z [m]"), p.u[2], 1e-14 * p.u.norm());
  EXPECT_NEAR(number(2, "M_11 [N]"), p.M[0], 1e-14 * p.M.norm());
  const double stress = shell::in_plane_stress(section_forces(p), p.thickness / 2)[0];
  EXPECT_NEAR(number(2, "stress_11_upper [Pa]"), stress, 1e-14 * std::abs(stress));
  const double inside = shell::in_plane_stress(section_forces(p), -0.375 * p.thickness)[0];
  EXPECT_NEAR(number(2, "stress_11_at_-0.375 [Pa]"), inside, 1e-14 * std::abs(stress));
  EXPECT_EQ(column("lambda [N m]"), rows[0].size());
  const Json json = Json::parse(text_of(scratch.path / "results.json"));
  EXPECT_NE(std::ranges::find(json["files"], Json("line-across.csv")), json["files"].end());
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(LineTable, is_plotted_in_the_report_and_has_the_names_of_units_of_the_case) {
  const ScratchDirectory scratch("units");
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  Output output(scratch.path, "solution", MPI_COMM_WORLD, true, {.units = {"mm", "N"}});
  output.finish(result, {}, {{"across", {{0.25, 0.5}, {0.5, 0.5}, {1, 0.5}}}});
  const std::string table = text_of(scratch.path / "line-across.csv"), page = text_of(scratch.path / "report.html"),
                    fields = text_of(scratch.path / "solution.vtu");
  EXPECT_TRUE(table.starts_with("s [mm],")) << table.substr(0, 80);
  EXPECT_NE(table.find("stress_11_upper [MPa]"), std::string::npos);
  EXPECT_NE(page.find("Profiles along lines"), std::string::npos);
  EXPECT_NE(page.find("bending moments along across: "), std::string::npos);
  EXPECT_NE(page.find("<th>area [mm^2]</th>"), std::string::npos);
  EXPECT_EQ(page.find("[m]"), std::string::npos);
  EXPECT_NE(fields.find("units=\"MPa\""), std::string::npos);
  EXPECT_EQ(fields.find("units=\"Pa\""), std::string::npos);
  const Json json = Json::parse(text_of(scratch.path / "results.json"));
  EXPECT_EQ(json["units"]["stress/max_von_mises"], "MPa");
  EXPECT_EQ(json["certificate_limits"]["min_gap_nodes"]["unit"], "mm");
  EXPECT_EQ(json["unit_names"], (Json{{"length", "mm"}, {"force", "N"}}));
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(LineTable, of_points_outside_of_the_domain_is_refused_by_name) {
  const computation::Result result = computation::solve(pressed_plate({.refinements = 1}), MPI_COMM_WORLD);
  EXPECT_THROW(computation::values_at(*result.solution, {{0.5, 0.5}, {3, 0}}, "the line \"across\""),
               mesh::DomainError);
}

}  // namespace

}  // namespace plastron::io
