// [[obstacle]]: each shape as it is read.
#include <gtest/gtest.h>
#include <plastron/config/case.hpp>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace plastron::config {
namespace {

using Eigen::Vector3d;
using obstacle::Obstacle;

/// Files are looked for beside tests/config/case.toml.
Obstacle read(const std::string& lines) {
  return parse_case(
             "[constants]\nR = 0.5\n[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = { disk = { radius = 1 "
             "} }\n"
             "chart = [\"x\", \"y\", 0]\n[[obstacle]]\n" +
                 lines,
             PLASTRON_SOURCE_DIR "/tests/config/case.toml")
      .problem.shell.obstacles.all.at(0);
}

double distance(const std::string& lines, const Vector3d& X) { return read(lines).nearest(X).distance; }

TEST(AnObstacle, IsAnyOfTheShapes) {
  EXPECT_NEAR(distance("ball = { centre = [0, 0, 1], radius = \"R\" }", {0, 0, 0}), 0.5, 1e-15);
  EXPECT_NEAR(distance("ball = { radius = \"R\", inside = true }", {0, 0, 0.1}), 0.4, 1e-15);
  EXPECT_NEAR(distance("cylinder = { radius = \"R\", axis = [2, 0, 0] }", {7, 0, 2}), 1.5, 1e-15);
  EXPECT_NEAR(distance("cylinder = { radius = \"R\", axis = [2, 0, 0], length = 2, fillet = 0.1 }", {7, 0, 0}), 6,
              1e-15);
  EXPECT_NEAR(distance("box = { size = [2, 4, 6], axes = [[0, 1, 0], [1, 0, 0]] }", {0, 3, 0}), 2, 1e-15);
  EXPECT_NEAR(distance("torus = { radius = \"R\", tube_radius = 0.1 }", {0, 1, 0}), 0.4, 1e-15);
  EXPECT_NEAR(distance("cone = { half_angle = \"pi/4\" }", {1, 0, 0}), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(distance("height_field = \"R*X\"", {0, 0, 1}), 1 / std::sqrt(1.25), 1e-15);
  EXPECT_NEAR(distance("height_field = 0.25", {0, 0, 1}), 0.75, 1e-15);
  EXPECT_NEAR(distance("height_field = { expression = \"R*X\" }", {0, 0, 1}), 1 / std::sqrt(1.25), 1e-15);
  EXPECT_GT(distance("height_field = { file = \"files/hills.asc\" }", {1, 0, 1}), 1);
  EXPECT_NEAR(distance("distance = \"X^2 + Y^2 + Z^2 - R^2\"", {0, 3, 4}), 4.5, 1e-14);
  EXPECT_NEAR(distance("surface = \"files/box.obj\"", {0.5, 0.5, 3}), 2, 1e-15);
}

TEST(ABed, IsANumberOrATable) {
  EXPECT_TRUE(read("half_space = {}").bed.is_rigid());
  EXPECT_EQ(read("half_space = {}\nbed = \"4*R\"").bed.pressure(2), 4);
  const obstacle::Bed bed = read("half_space = {}\nbed = { closure = [0, 1, 2], pressure = [0, \"R\", 3] }").bed;
  EXPECT_EQ(bed.pressure(1.5), 1.75);
  EXPECT_EQ(bed.pressure(3), 5.5);
}

TEST(FilesOfACase, AreListedAndMayLieInAnotherFolderThanTheCase) {
  const std::string text =
      "\xEF\xBB\xBF[shell]\nE = 1\nnu = 0\nthickness = 1\n[geometry]\ndomain = { disk = { radius = 1 } }\n"
      "chart = [\"x\", \"y\", 0]\r\n[[obstacle]]\nname = \"hills\"\nheight_field = { file = \"hills.asc\" }\n"
      "[[obstacle]]\nname = \"box\"\nsurface = \"box.obj\"\n";
  const auto file = std::filesystem::path(testing::TempDir()) / "plastron-files-of-a-case.toml";
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_THROW(read_case(file), CaseErrors);
  const std::filesystem::path folder = PLASTRON_SOURCE_DIR "/tests/config/files";
  const Case c = read_case(file, folder);
  EXPECT_EQ(c.text, text);
  ASSERT_EQ(c.files.size(), 2u);
  EXPECT_EQ(c.files[0].first, "hills.asc");
  EXPECT_EQ(c.files[0].second, folder / "hills.asc");
  EXPECT_EQ(c.files[1].first, "box.obj");
  std::filesystem::remove(file);
}

TEST(AnObstacle, IsTurnedAndThenShifted) {
  const std::string placed =
      "\nrotate = { axis = [0, 1, 0], angle = \"pi/2\", about = [0, 0, 1] }\ntranslate = [3, 0, 0]";
  EXPECT_NEAR(distance("half_space = {}" + placed, {5, 7, 9}), 3, 1e-14);
}

}  // namespace
}  // namespace plastron::config
