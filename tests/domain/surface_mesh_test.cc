// Meshes in space from files: names, folds, scale, orientation, and the coarse mesh that is made of them.
#include "domain/space_surface.hpp"
#include "domain/written_mesh.hpp"

#include <plastron/domain/mesh_data.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/surface_patches.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plastron::domain {
namespace {

using namespace space_meshes;            // NOLINT: builders of meshes
using namespace topology::space_meshes;  // NOLINT: builders of meshes
using testing::ElementsAre;
using testing::HasSubstr;

/// Two unit squares in a right angle along the y axis; the second one is turned round. The line between them is a named
/// curve.
const std::string folded = written::header +
                           "$PhysicalNames\n3\n1 1 \"bend\"\n2 2 \"floor\"\n2 3 \"wall\"\n$EndPhysicalNames\n"
                           "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 0 1 1\n$EndNodes\n"
                           "$Elements\n3\n1 1 2 1 1 1 4\n2 3 2 2 1 1 2 3 4\n3 3 2 3 2 1 5 6 4\n$EndElements\n";

MeshFile file_of(const written::TemporaryPath& path, const std::string& text, SpaceReading reading = {}) {
  std::ofstream(path.path) << text;
  return {.path = path.path.string(), .in_space = std::move(reading)};
}

std::string refusal(const std::string& text, SpaceReading reading = {}) {
  const written::TemporaryPath path(".msh");
  try {
    (void)coarse_mesh(file_of(path, text, std::move(reading)), mesh::Shape::quadrilateral);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  return "";
}

/// The two squares with normals of their own; the second one's are on its other side. `wall` is that of the wall.
std::string with_normals(const std::string& wall, const std::string& elements = "2") {
  return folded + "$ElementNodeData\n1\n\"normal\"\n1\n0\n3\n0\n3\n" + elements +
         "\n2 4 0 0 1 0 0 1 0 0 1 0 0 1\n3 4 " + wall + " " + wall + " " + wall + " " + wall +
         "\n$EndElementNodeData\n";
}

TEST(SurfaceMesh, TakesTheNormalsOfCells) {
  const written::TemporaryPath path(".msh");
  // Tilted by 3 degrees: the mesh is not the part, and the part's normals count.
  const double tilt = 3 * std::numbers::pi / 180;
  const FileSurface surface =
      read_surface(file_of(path, with_normals(fmt::format("{} {} 0", -2 * std::cos(tilt), -2 * std::sin(tilt)))), {});
  int found = 0;
  for (const topology::DirectorNode& node : surface.topology.director_nodes)
    if (std::abs(node.director[2]) < 0.5) {
      EXPECT_NEAR(std::abs(node.director[0]), std::cos(tilt), 1e-14);
      EXPECT_NEAR(std::abs(node.director[1]), std::sin(tilt), 1e-14);
      ++found;
    }
  EXPECT_EQ(found, 4);
  // Faces of a part meet smoothly to a degree, elements with means of normals to ten.
  EXPECT_NEAR(surface.topology.smooth_angle, std::numbers::pi / 180, 1e-14);
}

TEST(SurfaceMesh, RefusesWrongNormalsOfCells) {
  EXPECT_THAT(refusal(with_normals("0 0 1")), HasSubstr("more than 60 degrees off"));
  EXPECT_THAT(refusal(with_normals("0 0 nan")), HasSubstr("a coordinate"));
  EXPECT_THAT(refusal(with_normals("1 0")), HasSubstr("a coordinate"));
  EXPECT_THAT(refusal(with_normals("1 0 0 0")), HasSubstr("is more than the line should hold"));
  EXPECT_THAT(refusal(with_normals("1 0 0", "999999999")), HasSubstr("the number of elements with normals"));
  EXPECT_THAT(refusal(folded + "$Notes\n2\nhello\n$EndNotes\n"), HasSubstr("Notes"));
}

TEST(SurfaceMesh, TellsNotesAndWarningsOfItsFile) {
  const written::TemporaryPath path(".msh");
  const FileSurface surface =
      read_surface(file_of(path, folded + "$Notes\n2\nmade of two faces\nwarning: rough\n$EndNotes\n"), {});
  EXPECT_THAT(surface.notes, ElementsAre("made of two faces"));
  EXPECT_THAT(surface.warnings, ElementsAre("rough"));
}

TEST(SurfaceMesh, HasNamesFoldsAndOneOrientation) {
  const written::TemporaryPath path(".msh");
  const FileSurface surface = read_surface(file_of(path, folded), {});
  EXPECT_THAT(surface.regions, ElementsAre("floor", "wall"));
  EXPECT_EQ(topology::summary_of(surface.topology).turned, 1U);
  const mesh::CoarseMesh mesh = surface_mesh(surface, mesh::Shape::quadrilateral);
  EXPECT_THAT(mesh.boundaries, ElementsAre("bend", "fold 1"));
  EXPECT_THAT(mesh.fold_boundaries, ElementsAre("fold 1"));
  EXPECT_EQ(mesh.folds.size(), 1U);
  EXPECT_EQ(mesh.vertices.size(), 8U);  // two of them twice
  // The named curve is listed for one side of the fold, the fold for both.
  EXPECT_EQ(std::ranges::count(mesh.edges, 0, &mesh::BoundaryEdge::boundary), 1);
  EXPECT_EQ(std::ranges::count(mesh.edges, 1, &mesh::BoundaryEdge::boundary), 2);
}

TEST(SurfaceMesh, HasTheScaleAndTheSideThatTheCaseNames) {
  const written::TemporaryPath path(".msh");
  const Vector3d below(0, 0, -1);
  const MeshFile file = file_of(path, folded, {.scale = 1e-3, .upper = below});
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(coarse_mesh(file, mesh::Shape::quadrilateral)),
                             {});
  const geometry::Frame frame = surface.frame({.coarse = 0}, {0.25, 0.5});
  EXPECT_LT((frame.a3 - below).norm(), 1e-14);
  EXPECT_LT((geometry::surface_normal(frame) - below).norm(), 1e-14);
  EXPECT_NEAR(frame.sqrt_a, 1e-6, 1e-18);
}

TEST(SurfaceMesh, IsSmoothBelowTheAngleThatTheCaseNames) {
  const written::TemporaryPath path(".msh");
  EXPECT_TRUE(coarse_mesh(file_of(path, folded, {.smooth_angle = 1.6}), mesh::Shape::quadrilateral).folds.empty());
  const std::string flat =
      folded.substr(0, folded.find("5 0 0 1")) + "5 -1 0 0\n6 -1 1 0" + folded.substr(folded.find("\n$EndNodes"));
  EXPECT_TRUE(coarse_mesh(file_of(path, flat), mesh::Shape::quadrilateral).folds.empty());
  EXPECT_EQ(
      surface_mesh(read_surface(file_of(path, flat, {.folds = {"bend"}}), {}), mesh::Shape::quadrilateral).folds.size(),
      1U);
}

TEST(SurfaceMesh, LiesAtTheOffsetFromTheFile) {
  const FileSurface file = surface_of(sphere(mesh::Shape::quadrilateral, 3, 4));
  // The file of a sphere of radius 1; the mid-surface is half of a thickness of 0.1 inside of it.
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(file.topology.mesh.nodes.size()) + "\n";
  for (std::size_t n = 0; n < file.topology.mesh.nodes.size(); ++n) {
    const Vector3d& x = file.topology.mesh.nodes[n];
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", n + 1, x[0], x[1], x[2]);
  }
  text += "$EndNodes\n$Elements\n" + std::to_string(file.topology.mesh.cells.size()) + "\n";
  const auto places = lattice_places(mesh::Shape::quadrilateral, 4);
  for (std::size_t c = 0; c < file.topology.mesh.cells.size(); ++c) {
    text += fmt::format("{} 37 2 0 1", c + 1);
    for (const std::size_t place : places) text += fmt::format(" {}", file.topology.mesh.cells[c].nodes[place] + 1);
    text += "\n";
  }
  text += "$EndElements\n";
  const written::TemporaryPath path(".msh");
  const MeshFile moved = file_of(path, text, {.offset = {.part = -0.5, .thickness = geometry::Expression(0.1)}});
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(coarse_mesh(moved, mesh::Shape::quadrilateral)),
                             {});
  for (int c = 0; c < 54; ++c) EXPECT_NEAR(surface.frame({.coarse = c}, {0.3, 0.6}).phi.norm(), 0.95, 1e-4);
  EXPECT_THAT(refusal(folded, {.offset = {.part = 0.5}}), HasSubstr("an offset would tear it"));
}

/// Half of a tube of radius 1 above the plane z = 0, of facets. Its two edges in the plane have one name.
std::string half_tube(double length) {
  constexpr int around = 8, along = 4;
  std::string nodes, cells;
  const auto node = [](int i, int j) { return 1 + i + (around + 1) * j; };
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= around; ++i) {
      const double angle = std::numbers::pi * i / around;
      nodes += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", node(i, j), std::cos(angle), length * j / along,
                           i % around == 0 ? 0 : std::sin(angle));
    }
  int count = 0;
  for (int j = 0; j < along; ++j) {
    for (const int i : {0, around}) cells += fmt::format("{} 1 2 1 1 {} {}\n", ++count, node(i, j), node(i, j + 1));
    for (int i = 0; i < around; ++i)
      cells += fmt::format("{} 3 2 2 2 {} {} {} {}\n", ++count, node(i, j), node(i + 1, j), node(i + 1, j + 1),
                           node(i, j + 1));
  }
  return written::header + "$PhysicalNames\n2\n1 1 \"plane\"\n2 2 \"tube\"\n$EndPhysicalNames\n" +
         fmt::format("$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n", (around + 1) * (along + 1), nodes,
                     count, cells);
}

TEST(PlaneOfSymmetry, IsFoundFromTwoParallelEdges) {
  for (const double length : {0.5, 2.0, 5.0, 30.0}) {
    const written::TemporaryPath path(".msh");
    FileSurface surface = read_surface(file_of(path, half_tube(length), {.smooth_angle = 1}), {});
    put_into_plane("plane", surface);
    EXPECT_GT(surface.symmetry_turn, 1e-3) << length;
    for (const topology::DirectorNode& at : surface.topology.director_nodes) {
      const Vector3d& place = surface.topology.mesh.nodes[static_cast<std::size_t>(at.node)];
      if (place[2] != 0) continue;
      EXPECT_NEAR(at.director[2], 0, 1e-12) << length;
    }
  }
}

TEST(SurfaceMesh, IsCutCrosswiseForTriangles) {
  const written::TemporaryPath path(".msh");
  const mesh::CoarseMesh mesh = coarse_mesh(file_of(path, folded), mesh::Shape::triangle);
  EXPECT_EQ(mesh.cells.size(), 8U);
  EXPECT_EQ(mesh.folds.size(), 1U);
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(mesh), {});
  double area = 0;
  for (int c = 0; c < 8; ++c) area += surface.frame({.coarse = c}, {1.0 / 3, 1.0 / 3}).sqrt_a / 2;
  EXPECT_NEAR(area, 2, 1e-14);
}

TEST(SurfaceMesh, IsRefusedWithTheReason) {
  EXPECT_THAT(refusal(folded, {.folds = {"edge"}}), HasSubstr("there is no curve \"edge\""));
  EXPECT_THAT(refusal(written::header + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n0\n$EndElements\n"),
              HasSubstr("it has no quadrilaterals"));
}

TEST(SurfaceMesh, IsRefusedWithAllReasonsInOneLine) {
  const std::string crossed = "$Elements\n4\n1 1 2 1 1 1 4\n2 3 2 2 1 1 2 3 4\n3 3 2 3 2 1 6 5 4\n4 3 2 2 1 1 2 3 4\n";
  const std::string text = refusal(folded.substr(0, folded.find("$Elements")) + crossed + "$EndElements\n");
  EXPECT_THAT(text, HasSubstr("elements have the same corners"));
  EXPECT_THAT(text, HasSubstr("; also: "));
  EXPECT_THAT(text, HasSubstr("is degenerate or folds over"));
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(SurfaceMesh, GivesAddressesThatLeadBackToTheirPoints) {
  const FileSurface file = surface_of(sphere(mesh::Shape::quadrilateral, 2, 3));
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(surface_mesh(file, mesh::Shape::quadrilateral)),
                             {});
  for (const Vector3d& wanted : {Vector3d(0.9, 0.1, 0.2), Vector3d(0, 0, -1.2), Vector3d(0.5, -0.5, 0.5)}) {
    const fem::NearestPoint nearest = nearest_point(surface, wanted);
    EXPECT_LT((nearest.place - wanted.normalized()).norm(), 5e-3);
    EXPECT_NEAR(nearest.distance, std::abs(1 - wanted.norm()), 1e-3);
    const auto location = fem::locate(surface.coarse(), nearest.point);
    ASSERT_TRUE(location);
    EXPECT_LT((surface.frame({.coarse = location->coarse}, location->xi).phi - nearest.place).norm(), 1e-12);
  }
}

TEST(NearestPoint, OfAChartIsTheFootOfTheNormal) {
  const fem::Surface surface(std::make_shared<const mesh::CoarseMesh>(coarse_mesh(Disk{}, mesh::Shape::quadrilateral)),
                             {{"", geometry::Chart({"x", "y", "x^2 + y^2"}, {})}});
  const Vector3d foot(0.3, -0.2, 0.13), normal = Vector3d(-0.6, 0.4, 1).normalized();
  const fem::NearestPoint nearest = nearest_point(surface, foot + 0.1 * normal);
  EXPECT_LT((nearest.place - foot).norm(), 1e-7);
  EXPECT_LT((nearest.point - Vector2d(0.3, -0.2)).norm(), 1e-7);
}

}  // namespace
}  // namespace plastron::domain
