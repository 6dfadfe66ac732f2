// Files of triangles: names of solids and groups.
#include <plastron/geometry/file_error.hpp>
#include <plastron/geometry/triangle_mesh.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace plastron::geometry {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TriangleMesh read(const std::string& ending, const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() / ("plastron-triangles-" + std::to_string(getpid()) + ending);
  std::ofstream(path) << text;
  const struct Removal {
    const std::filesystem::path& path;
    ~Removal() { std::filesystem::remove(path); }
  } removal{path};
  return read_triangle_mesh(path.string());
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
}

TEST(TriangleFile, OfStlHasTheNamesOfAllItsSolids) {
  const std::string first = facet("0 0 0", "1 0 0", "0 1 0"), second = facet("1 0 0", "1 1 0", "0 1 0");
  const TriangleMesh mesh = read(
      ".stl", "solid floor of the part\n" + first + "endsolid floor of the part\nsolid wall\n" + second + "endsolid\n");
  EXPECT_THAT(mesh.groups, ElementsAre("floor of the part", "wall"));
  EXPECT_THAT(mesh.group_of, ElementsAre(0, 1));
  EXPECT_EQ(mesh.points.size(), 4U);
  const TriangleMesh nameless = read(".STL", "solid\n" + first + "endsolid\nsolid\n" + second + "endsolid\n");
  EXPECT_THAT(nameless.groups, IsEmpty());
  EXPECT_THAT(nameless.group_of, IsEmpty());
  EXPECT_EQ(nameless.triangles.size(), 2U);
}

TEST(TriangleFile, OfStlWithWordsBehindItsSolidsIsRefused) {
  const std::string solid = "solid a\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid a\n";
  try {
    read(".stl", solid + "facet normal 0 0 1\n");
    FAIL() << "accepted";
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("line 10: \"solid\" should stand here"));
  }
}

TEST(TriangleFile, OfObjHasItsGroups) {
  const TriangleMesh mesh = read(
      ".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\ng lid\nf 1 3 4\no rim\nv 0 0 1\nf 1 2 5\ng lid\nf 2 3 5\n");
  EXPECT_THAT(mesh.groups, ElementsAre("lid", "rim"));
  EXPECT_THAT(mesh.group_of, ElementsAre(-1, 0, 1, 0));
}

TEST(TriangleFile, KeepsItsGroupsWherePointsAreJoined) {
  // The second triangle loses its short side when points are joined.
  TriangleMesh mesh{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 1 + 1e-3, 0}, {2, 0, 0}},
                    .triangles = {{0, 1, 2}, {1, 3, 4}, {1, 5, 3}},
                    .groups = {"a", "b", "c"},
                    .group_of = {0, 1, 2}};
  join_near_points(mesh, 2e-3);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_THAT(mesh.group_of, ElementsAre(0, 2));
}

}  // namespace
}  // namespace plastron::geometry
