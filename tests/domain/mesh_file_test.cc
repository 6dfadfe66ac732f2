// Meshes from Gmsh files: what is read, and the words in which files are refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "domain/written_mesh.hpp"
#include "fem/mesh_measure.hpp"

namespace plastron::domain {
namespace {

using namespace written;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

TEST(MeshFile, of_either_version_gives_the_same_mesh) {
  const mesh::CoarseMesh old_mesh = read("quarter-annulus-2.2.msh"), new_mesh = read("quarter-annulus-4.1.msh");
  for (const mesh::CoarseMesh& mesh : {old_mesh, new_mesh}) {
    fem::expect_cells_fit(mesh);
    EXPECT_EQ(mesh.cells.size(), 4u);
    EXPECT_EQ(mesh.vertices.size(), 9u);
    EXPECT_EQ(mesh.edges.size(), 8u);
    EXPECT_THAT(mesh.boundaries, UnorderedElementsAre("flat sides", "outer", "inner"));
    EXPECT_THAT(mesh.regions, ElementsAre("sector"));
  }
  EXPECT_NEAR(fem::area(old_mesh), fem::area(new_mesh), 1e-14);
}

TEST(MeshFile, of_second_order_has_curved_cells) {
  const mesh::CoarseMesh mesh = read("quarter-annulus-2.2.msh");
  EXPECT_NEAR(fem::area(mesh), 0.75 * std::numbers::pi, 3e-3);  // straight sides would miss 0.23 of it
  EXPECT_GT(std::abs(fem::area(mesh) - 0.75 * std::numbers::pi), 1e-7);
  double outermost = 0;
  for (const mesh::CoarseCell& c : mesh.cells)
    for (const double t : {0.0, 0.5, 1.0})
      for (int side = 0; side < 4; ++side)
        outermost = std::max(outermost, c.map(mesh::side_point(mesh.shape, side, t)).value.norm());
  EXPECT_NEAR(outermost, 2, 1e-8);
}

TEST(MeshFile, names_regions_by_physical_surfaces_and_boundaries_by_physical_curves) {
  const mesh::CoarseMesh mesh = read("two-regions-4.1.msh");
  fem::expect_cells_fit(mesh);
  EXPECT_THAT(mesh.regions, UnorderedElementsAre("plate", "wing"));
  EXPECT_THAT(mesh.boundaries, UnorderedElementsAre("clamped", "junction", "free"));
  for (const mesh::CoarseCell& c : mesh.cells)
    EXPECT_EQ(mesh.regions[static_cast<std::size_t>(c.region)], c.map({0.5, 0.5}).value[0] < 1 ? "plate" : "wing");
  EXPECT_NEAR(fem::area(mesh), 3, 1e-13);
}

TEST(MeshFile, may_hold_cells_drawn_clockwise) {
  const mesh::CoarseMesh mesh = read("clockwise-2.2.msh");
  fem::expect_cells_fit(mesh);  // every cell positive
  EXPECT_NEAR(fem::area(mesh), 2.75, 1e-14);
}

TEST(MeshFile, of_one_square_is_read) {
  const mesh::CoarseMesh mesh = read_text(header + names + square + cell);
  fem::expect_cells_fit(mesh);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_THAT(mesh.boundaries, ElementsAre("edge"));
}

TEST(MeshFile, without_physical_surfaces_has_one_unnamed_region) {
  const mesh::CoarseMesh mesh = read_text(header + "$PhysicalNames\n1\n1 1 \"edge\"\n$EndPhysicalNames\n" + square +
                                          "$Elements\n5\n" + edges + "5 3 2 0 1 1 2 3 4\n$EndElements\n");
  EXPECT_THAT(mesh.regions, ElementsAre(""));
  EXPECT_EQ(mesh.cells.size(), 1u);
}

TEST(WrongMeshFile, that_is_not_there_is_named) {
  try {
    coarse_mesh(MeshFile{"/no/such/plate.msh"}, mesh::Shape::quadrilateral);
    FAIL();
  } catch (const mesh::DomainError& error) {
    EXPECT_STREQ(error.what(), "/no/such/plate.msh: there is no such mesh file");
  }
  EXPECT_THROW(coarse_mesh(MeshFile{std::filesystem::temp_directory_path().string()}, mesh::Shape::quadrilateral),
               mesh::DomainError);
}

TEST(WrongMeshFile, that_is_no_mesh_is_refused) {
  EXPECT_NE(refusal(""), "");
  EXPECT_NE(refusal("hello\n"), "");
  EXPECT_NE(refusal(header + square + "$Elements\n1\n1 3 2 2 1 1 2 3"), "");
  EXPECT_NE(refusal(header + names + square + "$Elements\n1\n5 3 2 2 1 1 2 3 9\n$EndElements\n"), "");
}

// Every node of the file is used in Gmsh's order. Otherwise sides would not fit and the area would be wrong.
TEST(MeshFile, of_fourth_order_has_its_nodes_in_place) {
  for (const char* name : {"arcs-of-order-4-4.1.msh", "arcs-of-order-4-2.2.msh"}) {
    const mesh::CoarseMesh mesh = read(name);
    fem::expect_cells_fit(mesh);
    EXPECT_EQ(mesh.cells.size(), 4u);
    EXPECT_NEAR(fem::area(mesh), 0.75 * std::numbers::pi, 1e-5);
  }
  const mesh::CoarseMesh triangles = read("arc-triangles-of-order-4-4.1.msh", mesh::Shape::triangle);
  fem::expect_cells_fit(triangles);
  EXPECT_EQ(triangles.cells.size(), 16u);
  EXPECT_NEAR(fem::area(triangles), 0.75 * std::numbers::pi, 1e-5);
}

// "rim" is the whole boundary and contains "south". Format 2.2 lists the common lines once for each.
TEST(MeshFile, may_have_curves_in_several_groups) {
  for (const char* name : {"arcs-of-order-4-4.1.msh", "arcs-of-order-4-2.2.msh", "arcs-2.2.msh"}) {
    const mesh::CoarseMesh mesh = read(name);
    std::map<std::string, int> edges;
    for (const mesh::BoundaryEdge& e : mesh.edges) ++edges[mesh.boundaries[static_cast<std::size_t>(e.boundary)]];
    EXPECT_EQ(edges["rim"], 8) << name;
    EXPECT_EQ(edges["south"], 2) << name;
    EXPECT_EQ(edges["mid"], 2) << name;
  }
}

TEST(MeshFile, joins_groups_of_one_name) {
  const mesh::CoarseMesh mesh =
      read_text(header + "$PhysicalNames\n3\n1 1 \"edge\"\n1 7 \"edge\"\n2 2 \"plate\"\n$EndPhysicalNames\n" + square +
                "$Elements\n3\n1 1 2 1 1 1 2\n2 1 2 7 2 2 3\n" + "5 3 2 2 1 1 2 3 4\n$EndElements\n");
  EXPECT_THAT(mesh.boundaries, ElementsAre("edge"));
  EXPECT_EQ(mesh.edges.size(), 2u);
}

TEST(MeshFile, may_have_points_unused_nodes_other_sections_and_windows_line_ends) {
  std::string text = header + "$Comments\nSystemCall \"touch /tmp/x\";\n$EndComments\n" + names +
                     "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n99 7 7 7\n$EndNodes\n" +
                     "$Elements\n2\n1 15 2 0 1 1\n5 3 2 2 1 1 2 3 4\n$EndElements\n$NodeData\n1\n$EndNodeData\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const mesh::CoarseMesh mesh = read_text(text);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

// Four triangles of second order around the origin on the unit circle. The third one is drawn clockwise.
TEST(MeshFile, of_triangles_of_second_order_has_curved_cells) {
  const mesh::CoarseMesh mesh = read("triangle-circle-2.2.msh", mesh::Shape::triangle);
  EXPECT_EQ(mesh.shape, mesh::Shape::triangle);
  fem::expect_cells_fit(mesh);
  EXPECT_EQ(mesh.cells.size(), 4u);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_THAT(mesh.boundaries, UnorderedElementsAre("right", "left"));
  // Each side is a parabola over a chord of length sqrt(2) with the sagitta 1 - 1/sqrt(2): two thirds of their product.
  EXPECT_NEAR(fem::area(mesh), 2 + 4 * 2.0 / 3 * std::sqrt(2.0) * (1 - std::sqrt(0.5)), 1e-13);
}

TEST(MeshFile, of_quadrilaterals_is_cut_crosswise_where_triangles_are_wanted) {
  for (const char* name : {"quarter-annulus-2.2.msh", "two-regions-4.1.msh", "clockwise-2.2.msh"}) {
    const mesh::CoarseMesh whole = read(name), cut = read(name, mesh::Shape::triangle);
    fem::expect_cells_fit(cut);
    EXPECT_EQ(cut.cells.size(), 4 * whole.cells.size());
    EXPECT_EQ(cut.vertices.size(), whole.vertices.size() + whole.cells.size());
    EXPECT_EQ(cut.edges.size(), whole.edges.size());
    EXPECT_EQ(cut.regions, whole.regions);
    EXPECT_NEAR(fem::area(cut), fem::area(whole), 1e-13);
  }
}

TEST(MeshFile, may_mix_triangles_and_quadrilaterals_where_triangles_are_wanted) {
  const mesh::CoarseMesh mesh = read_text(header + names +
                                              "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 .5 0\n$EndNodes\n"
                                              "$Elements\n2\n1 3 2 2 1 1 2 3 4\n2 2 2 2 1 2 5 3\n$EndElements\n",
                                          mesh::Shape::triangle);
  fem::expect_cells_fit(mesh);
  EXPECT_EQ(mesh.cells.size(), 5u);
  EXPECT_NEAR(fem::area(mesh), 1.5, 1e-14);
}

TEST(WrongMeshFile, of_incomplete_triangles_is_told_to_complete_them) {
  const std::string nine_nodes =
      "$Nodes\n9\n1 0 0 0\n2 3 0 0\n3 0 3 0\n4 1 0 0\n5 2 0 0\n6 2 1 0\n7 1 2 0\n8 0 2 0\n9 0 1 0\n$EndNodes\n";
  EXPECT_THAT(refusal(header + names + nine_nodes + "$Elements\n1\n1 20 2 2 1 1 2 3 4 5 6 7 8 9\n$EndElements\n",
                      mesh::Shape::triangle),
              HasSubstr("only complete triangles"));
}

TEST(WrongMeshFile, of_triangles_is_told_to_recombine_or_to_ask_for_triangles) {
  const std::string message =
      refusal(header + names + square + "$Elements\n2\n1 2 2 2 1 1 2 3\n2 2 2 2 1 1 3 4\n$EndElements\n");
  EXPECT_THAT(message, HasSubstr("Triangle"));
  EXPECT_THAT(message, HasSubstr("Recombine"));
  EXPECT_THAT(message, HasSubstr("cells = \"triangle\""));
}

TEST(WrongMeshFile, of_incomplete_quadrilaterals_is_told_to_complete_them) {
  const std::string eight_nodes =
      "$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 .5 0 0\n6 1 .5 0\n7 .5 1 0\n8 0 .5 0\n$EndNodes\n";
  EXPECT_THAT(refusal(header + names + eight_nodes + "$Elements\n1\n1 16 2 2 1 1 2 3 4 5 6 7 8\n$EndElements\n"),
              HasSubstr("SecondOrderIncomplete"));
}

TEST(WrongMeshFile, that_leaves_the_parameter_plane_names_the_node) {
  std::string raised = square;
  raised.replace(raised.find("3 1 1 0"), 7, "3 1 1 .1");
  const std::string message = refusal(header + names + raised + cell);
  EXPECT_THAT(message, HasSubstr("node 3"));
  EXPECT_THAT(message, HasSubstr("z = 0.1"));
}

TEST(WrongMeshFile, with_unnamed_groups_is_told_to_name_them) {
  EXPECT_THAT(refusal(header + square + cell), HasSubstr("physical surface 2 has no name"));
  EXPECT_THAT(refusal(header + "$PhysicalNames\n1\n2 2 \"plate\"\n$EndPhysicalNames\n" + square + cell),
              HasSubstr("physical curve 1 has no name"));
}

TEST(WrongMeshFile, without_cells_is_refused) {
  EXPECT_THAT(refusal(header + names + square + "$Elements\n4\n" + edges + "$EndElements\n"),
              HasSubstr("no quadrilaterals"));
}

}  // namespace
// A corner of a solid block: its tetrahedron, and triangles of its boundary in `groups` as a tag.
std::string solid(int group) {
  const std::string triangles = fmt::format("1 2 2 {0} 1 1 2 3\n2 2 2 {0} 1 1 2 4\n", group);
  return header + names + "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n$Elements\n3\n" + triangles +
         "3 4 2 0 1 1 2 3 4\n$EndElements\n";
}

TEST(MeshFile, of_a_solid_is_no_shell) {
  for (const mesh::Shape shape : {mesh::Shape::triangle, mesh::Shape::quadrilateral})
    EXPECT_THAT(refusal(solid(0), shape), HasSubstr("it is the mesh of a solid, with 1 volume elements"));
  EXPECT_THAT(refusal(solid(2), mesh::Shape::triangle), testing::Not(HasSubstr("mesh of a solid")));
}

}  // namespace plastron::domain
