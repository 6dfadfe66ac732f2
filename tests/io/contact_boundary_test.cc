// contact-boundary.csv and .vtu, contact-forces.csv, read back.
#include <plastron/io/contact_report.hpp>
#include <plastron/workflow/output.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/pressed_plate.hpp>
#include <io/scratch_directory.hpp>

#include <array>
#include <map>
#include <sstream>
#include <tuple>

namespace plastron::io {

namespace {

using testing::IsSupersetOf;
using testing::Not;
using workflow::write_output;

/// Obstacle, zone, line -> rows of x, y, X, Y, Z, rim.
std::map<std::array<int, 3>, std::vector<std::array<double, 6>>> rows_of(const std::string& csv) {
  std::map<std::array<int, 3>, std::vector<std::array<double, 6>>> lines;
  std::istringstream text(csv);
  std::string row;
  std::getline(text, row);
  EXPECT_EQ(row, "obstacle,zone,line,x,y,X,Y,Z,rim");
  while (std::getline(text, row)) {
    std::ranges::replace(row, ',', ' ');
    std::istringstream numbers(row);
    std::array<int, 3> key{};
    std::array<double, 6> values{};
    for (int& k : key) numbers >> k;
    for (double& v : values) numbers >> v;
    EXPECT_TRUE(numbers) << row;
    lines[key].push_back(values);
  }
  return lines;
}

/// The numbers of one array of the .vtu file.
std::vector<double> array_of(const std::string& vtu, const std::string& attributes) {
  const auto at = vtu.find("<DataArray " + attributes);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no array " << attributes;
    return {};
  }
  const auto begin = vtu.find('>', at) + 1;
  std::istringstream text(vtu.substr(begin, vtu.find('<', begin) - begin));
  std::vector<double> numbers;
  for (double v = 0; text >> v;) numbers.push_back(v);
  return numbers;
}

TEST(ContactBoundary, files_hold_the_lines_of_the_result) {
  const ScratchDirectory scratch("boundary");
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  write_output(result, {}, scratch.path, "solution", MPI_COMM_WORLD);
  const auto& zones = result.summary.obstacles.at(0).zones;
  ASSERT_EQ(zones.size(), 1U);
  ASSERT_FALSE(zones[0].lines.empty());
  const auto lines = rows_of(text_of(scratch.path / "contact-boundary.csv"));
  const std::string vtu = text_of(scratch.path / "contact-boundary.vtu");
  const auto points = array_of(vtu, R"(type="Float64" NumberOfComponents="3")");
  const auto offsets = array_of(vtu, R"(type="Int64" Name="offsets")");
  ASSERT_EQ(lines.size(), zones[0].lines.size());
  ASSERT_EQ(offsets.size(), lines.size());
  EXPECT_EQ(array_of(vtu, R"(type="UInt8" Name="types")"), std::vector<double>(lines.size(), 4));
  EXPECT_EQ(array_of(vtu, R"(type="Int64" Name="zone")"), std::vector<double>(lines.size(), 0));
  std::size_t at = 0;
  for (std::size_t l = 0; l < zones[0].lines.size(); ++l) {
    const solution::ContactLine& line = zones[0].lines[l];
    const auto& rows = lines.at({0, 0, static_cast<int>(l)});
    ASSERT_EQ(rows.size(), line.points.size());
    for (std::size_t i = 0; i < rows.size(); ++i, ++at) {
      const auto& p = line.points[i];
      EXPECT_NEAR(rows[i][0], p.x[0], 1e-13);
      EXPECT_NEAR(rows[i][2], 2 * rows[i][0], 1e-13);  // the chart is (2x, y, 0.012)
      EXPECT_NEAR(rows[i][4], 0.012 - 0.01, 1e-13);    // the lower face
      EXPECT_NEAR(points.at(3 * at + 2), 0, 1e-4);     // has come down to the plane
      EXPECT_EQ(rows[i][5], line.is_rim ? 1 : 0);
    }
    EXPECT_EQ(offsets[l], static_cast<double>(at));
  }
  EXPECT_EQ(points.size(), 3 * at);
}

TEST(ContactBoundary, length_and_sums_stand_in_results_json) {
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  const Json json = results_json(result, {}), &obstacle = json["obstacles"][0], &zone = obstacle["zones"][0];
  EXPECT_NEAR(zone["area"].get<double>(), obstacle["area"].get<double>(), 1e-15);
  EXPECT_NEAR(zone["reaction"]["force"][2].get<double>(), obstacle["reaction"]["force"][2].get<double>(), 1e-10);
  EXPECT_NEAR(zone["centre_of_pressure"][0].get<double>(), 1, 1e-9);
  EXPECT_EQ(zone["peak"]["pressure"], json["contact"]["max_pressure"]);
  EXPECT_GT(zone["boundary"]["length"].get<double>(), 0);
  EXPECT_EQ(json["units"]["obstacles/*/zones/*/boundary/length"], "m");
}

TEST(ContactForces, add_up_to_the_reaction) {
  const ScratchDirectory scratch("forces");
  const computation::Result result = computation::solve(pressed_plate({.degree = 2, .refinements = 2}), MPI_COMM_WORLD);
  write_output(result, {}, scratch.path, "solution", MPI_COMM_WORLD);
  std::istringstream text(text_of(scratch.path / "contact-forces.csv"));
  std::string row;
  std::getline(text, row);
  EXPECT_EQ(row, "obstacle,x,y,X,Y,Z,u_X,u_Y,u_Z,F_X,F_Y,F_Z,eta,area");
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
  double area = 0;
  std::int64_t rows = 0;
  std::array<double, 2> before{-1, -1};
  for (; std::getline(text, row); ++rows) {
    std::ranges::replace(row, ',', ' ');
    std::istringstream numbers(row);
    std::array<double, 14> v{};
    for (double& value : v) numbers >> value;
    EXPECT_TRUE(numbers) << row;
    EXPECT_LT(before, (std::array{v[1], v[2]}));
    before = {v[1], v[2]};
    const Eigen::Vector3d place(v[3], v[4], v[5]), f(v[9], v[10], v[11]);
    force += f;
    moment += place.cross(f);
    area += v[13];
    EXPECT_NEAR(f.norm(), v[12] * v[13], 1e-13 * v[12]);
    EXPECT_NEAR(v[5] + v[8], 0, 1e-13);  // the lower face stands on the plane
  }
  const solution::ObstacleContact& whole = result.summary.obstacles.at(0);
  EXPECT_EQ(rows, whole.nodes);
  EXPECT_NEAR(area, whole.area, 0.15 * whole.area);  // nodes count fully here
  EXPECT_LT((force - whole.reaction.force).norm(), 1e-11 * force.norm());
  EXPECT_LT((moment - whole.reaction.moment).norm(), 1e-11 * moment.norm());
}

TEST(ContactBoundary, files_are_there_only_where_there_is_contact) {
  const ScratchDirectory scratch("no-boundary");
  const auto write = [&](bool obstacle) {
    const computation::Result result =
        computation::solve(pressed_plate({.refinements = 1, .obstacle = obstacle}), MPI_COMM_WORLD);
    write_output(result, {}, scratch.path, "solution", MPI_COMM_WORLD);
    MPI_Barrier(MPI_COMM_WORLD);
    return scratch.names();
  };
  EXPECT_THAT(write(true), IsSupersetOf({"contact-boundary.csv", "contact-boundary.vtu", "contact-forces.csv"}));
  MPI_Barrier(MPI_COMM_WORLD);
  const auto names = write(false);
  EXPECT_THAT(names, Not(testing::Contains("contact-boundary.csv")));
  EXPECT_THAT(names, Not(testing::Contains("contact-boundary.vtu")));
  EXPECT_THAT(names, Not(testing::Contains("contact-forces.csv")));
  MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace

}  // namespace plastron::io
