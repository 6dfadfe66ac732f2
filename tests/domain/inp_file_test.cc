// Meshes from input files of Abaqus and CalculiX: what is read, which names it gets, and the words in which files are
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "domain/written_deck.hpp"

namespace plastron::domain {
namespace {

using namespace written;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

using Names = std::vector<std::string>;

std::int64_t tag_of(const MeshData& data, std::int64_t node) { return data.nodes[static_cast<std::size_t>(node)].tag; }

/// The names of an element's groups.
Names groups(const MeshData& data, const MeshElement& element) {
  Names result;
  const int dimension = element_type(element.type)->is_cell() ? 2 : 1;
  for (const int group : data.group_sets[element.groups]) result.push_back(data.names.at({dimension, group}));
  return result;
}

/// The region of each cell in the order of the file; "" without one.
Names regions(const MeshData& data) {
  Names result;
  for (const MeshElement& element : data.elements)
    if (element_type(element.type)->is_cell()) {
      const Names names = groups(data, element);
      result.push_back(names.empty() ? "" : names.front());
    }
  return result;
}

/// The sides of a boundary by the numbers of their nodes, in their direction: "1-2", "1-2/5" with a middle.
Names sides(const MeshData& data, const std::string& boundary) {
  Names result;
  for (const MeshElement& element : data.elements) {
    const ElementType type = *element_type(element.type);
    const Names names = groups(data, element);
    if (type.is_cell() || std::ranges::find(names, boundary) == names.end()) continue;
    const auto tag = [&](std::size_t i) {
      return std::to_string(tag_of(data, data.element_nodes[element.first_node + i]));
    };
    result.push_back(tag(0) + "-" + tag(1) + (type.nodes == 3 ? "/" + tag(2) : ""));
  }
  return result;
}

std::string all_notes(const MeshData& data) {
  std::string result;
  for (const std::string& note : data.notes) result += note + "\n";
  return result;
}

TEST(InputFile, of_a_strip_of_squares_is_a_mesh) {
  const MeshData data = deck(strip);
  EXPECT_EQ(data.nodes.size(), 6u);
  EXPECT_EQ(data.elements.size(), 2u);
  EXPECT_EQ(place_of(data.elements[1]), "element 2 (line 10)");
  EXPECT_THAT(data.notes, IsEmpty());
  EXPECT_THAT(data.normals, IsEmpty());
  const mesh::CoarseMesh mesh = build_coarse_mesh(data, mesh::Shape::quadrilateral);
  EXPECT_EQ(mesh.cells.size(), 2u);
  EXPECT_THAT(mesh.regions, ElementsAre(""));
}

TEST(InputFile, may_have_all_types_of_shells_and_surfaces) {
  const auto cell_type = [](const std::string& type, int nodes) {
    std::string text = "*NODE\n";
    for (int i = 1; i <= nodes; ++i)
      text += std::to_string(i) + "," + std::to_string(i * i) + "," + std::to_string(i) + "\n";
    text += "*ELEMENT,TYPE=" + type + "\n1";
    for (int i = 1; i <= nodes; ++i) text += "," + std::to_string(i);
    const MeshData data = deck(text + "\n");
    EXPECT_EQ(data.elements.size(), 1u) << type;
    return element_type(data.elements.at(0).type)->name();
  };
  for (const char* type : {"S3", "S3R", "S3RS", "STRI3", "CPS3", "CPE3", "M3D3", "DS3", "SFM3D3"})
    EXPECT_EQ(cell_type(type, 3), "Triangle 3") << type;
  for (const char* type :
       {"S4", "s4r", "S4R5", "S4RS", "S4RSW", "CPS4", "CPS4R", "CPE4", "CPE4H", "M3D4", "M3D4R", "DS4"})
    EXPECT_EQ(cell_type(type, 4), "Quadrilateral 4") << type;
  for (const char* type : {"S6", "STRI65", "CPS6", "CPE6", "M3D6", "DS6"})
    EXPECT_EQ(cell_type(type, 6), "Triangle 6") << type;
  for (const char* type : {"S8", "S8R", "S8R5", "CPS8", "CPS8R", "CPE8", "M3D8", "M3D8R", "DS8"})
    EXPECT_EQ(cell_type(type, 8), "Quadrilateral 9") << type;
  for (const char* type : {"S9R5", "M3D9"}) EXPECT_EQ(cell_type(type, 9), "Quadrilateral 9") << type;
}

// Nodes are put at the points of the lattice where Abaqus has them. Gmsh's order must lead back to these points.
TEST(InputFile, has_nodes_in_gmsh_s_order) {
  const std::vector<std::array<int, 2>> triangle{{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<std::array<int, 2>> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  const auto expect_in_place = [](const std::string& type, const auto& points, mesh::Shape shape) {
    std::string nodes = "*NODE\n", element = "*ELEMENT, TYPE=" + type + "\n1";
    for (std::size_t i = 0; i < points.size(); ++i) {
      nodes += std::to_string(i + 1) + "," + std::to_string(points[i][0]) + "," + std::to_string(points[i][1]) + "\n";
      element += "," + std::to_string(i + 1);
    }
    const MeshData data = deck(nodes + element + "\n");
    const auto places = lattice_places(shape, 2);
    ASSERT_EQ(places.size(), points.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Eigen::Vector3d x = data.nodes[static_cast<std::size_t>(data.element_nodes[k])].position;
      const int i = static_cast<int>(x[0]), j = static_cast<int>(x[1]);
      EXPECT_EQ(places[k],
                static_cast<std::size_t>(shape == mesh::Shape::triangle ? j * 3 - j * (j - 1) / 2 + i : 3 * j + i));
    }
  };
  expect_in_place("S6", triangle, mesh::Shape::triangle);
  expect_in_place("STRI65", triangle, mesh::Shape::triangle);
  expect_in_place("S9R5", square, mesh::Shape::quadrilateral);
}

TEST(InputFile, of_quadrilaterals_of_8_nodes_gets_centres_on_their_surface) {
  const MeshData data = deck(curved_deck);
  ASSERT_EQ(data.nodes.size(), 9u);
  EXPECT_EQ(data.nodes[8].tag, 9);
  // The chart of curved_deck at s = t = 1/2: it has no term in s^2 t^2.
  EXPECT_LT((data.nodes[8].position - Eigen::Vector3d(0.5625, 0.5, 0.25)).norm(), 1e-15);
  EXPECT_EQ(data.elements.at(0).type, 10);
  EXPECT_EQ(data.element_nodes[8], 8);
  EXPECT_THAT(all_notes(data), HasSubstr("1 quadrilateral of 8 nodes"));
}

TEST(InputFile, may_have_fortran_s_exponents_points_without_zeros_and_empty_fields) {
  const MeshData data = deck(curved_deck);
  EXPECT_EQ(data.nodes[3].position, Eigen::Vector3d(0.25, 1, 0));
  EXPECT_EQ(data.nodes[4].position, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_EQ(data.nodes[6].position, Eigen::Vector3d(0.75, 1, 0.5));
}

TEST(InputFile, may_have_windows_line_ends_capitals_and_blanks_anywhere) {
  std::string text = "*node , NSET = a\n 1 ,0 , 0 \n2, 1,0,\n  3,1,1\n*eLeMeNt,\n  type = s3 ,\nELSET=p\n1, 1,2,\n3\n";
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  const MeshData data = deck(text);
  EXPECT_EQ(data.nodes.size(), 3u);
  EXPECT_THAT(regions(data), ElementsAre("p"));
  EXPECT_EQ(sides(data, "a").size(), 3u);
  EXPECT_EQ(deck("*NODE,\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT,TYPE=S3\n1,1,2,3").elements.size(), 1u);
}

TEST(InputFile, ends_elements_by_their_number_of_nodes) {
  const MeshData data = deck(strip_nodes + "*ELEMENT,TYPE=S4\n1,1,2,\n5,\n4\n2,\n2,3,6,5\n");
  EXPECT_EQ(data.elements.size(), 2u);
}

TEST(InputSets, name_sides_by_all_of_their_nodes) {
  const MeshData data = deck(curved_deck);
  EXPECT_THAT(sides(data, "south"), ElementsAre("1-2/5"));
  EXPECT_THAT(sides(data, "long side"), ElementsAre("4-1/8"));
  EXPECT_THAT(sides(data, "both"), UnorderedElementsAre("1-2/5", "4-1/8"));
  EXPECT_THAT(sides(data, "Nall").size(), 4u);
  EXPECT_THAT(sides(data, "east"), ElementsAre("2-3/6"));
  EXPECT_THAT(data.point_sets, ElementsAre(testing::Pair("corner", ElementsAre(2))));
  EXPECT_THAT(all_notes(data), HasSubstr("sets of points, here with their numbers of nodes: \"corner (1)\""));
}

TEST(InputSets, of_inner_nodes_name_inner_sides) {
  const MeshData data = deck(strip + "*NSET,NSET=seam\n2,5\n*NSET,NSET=corner and seam\n1,2,5\n");
  EXPECT_THAT(sides(data, "seam"), ElementsAre("2-5"));
  EXPECT_THAT(sides(data, "corner and seam"), ElementsAre("1-2"));
  EXPECT_THAT(all_notes(data),
              HasSubstr("on none of their sides, of which only the sides are read: \"corner and seam\""));
}

TEST(InputSets, add_up_and_contain_sets_that_follow) {
  const MeshData data = deck(strip +
                             "*NSET,NSET=A\nB,4\n*NSET,NSET=b\n1\n*NSET,NSET=a,GENERATE\n2,3\n*ELSET,ELSET=e\n2\n"
                             "*NSET,NSET=of e,ELSET=E\n");
  EXPECT_THAT(sides(data, "A"), UnorderedElementsAre("4-1", "1-2", "2-3"));
  EXPECT_THAT(sides(data, "of e"), UnorderedElementsAre("2-3", "3-6", "6-5"));
}

TEST(InputSets, that_contain_themselves_are_refused) {
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=A\nB\n*NSET,NSET=B\nA\n"),
              AllOf(HasSubstr("line 14"), HasSubstr("\"A\" contains itself")));
  EXPECT_THAT(deck_refusal(strip + "*ELSET,ELSET=A\nA\n"), HasSubstr("contains itself"));
}

TEST(InputSets, with_numbers_that_do_not_exist_are_noted) {
  EXPECT_THAT(all_notes(deck(strip + "*NSET,NSET=A\n1,4,77\n*ELSET,ELSET=E,GENERATE\n2,5\n")),
              AllOf(HasSubstr("sets name 1 node that the file does not have, first \"A\""),
                    HasSubstr("sets name 3 elements that the file does not have, first \"E\"")));
}

TEST(InputSets, with_unknown_names_are_refused) {
  EXPECT_THAT(
      deck_refusal(strip + "*NSET,NSET=A\n1,rim\n"),
      AllOf(HasSubstr("line 12"), HasSubstr("\"RIM\" is neither a whole number nor the name of a set of nodes")));
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=A\n1x2\n"), HasSubstr("\"1X2\" is neither"));
  EXPECT_THAT(deck_refusal(strip + "*SHELL SECTION, ELSET=skin\n1.\n"), AllOf(HasSubstr("line 11"), HasSubstr("SKIN")));
}

TEST(InputSets, cannot_exceed_the_memory) {
  std::string text = strip + "*ELSET,ELSET=S0\n1,2\n";
  for (int i = 1; i < 300; ++i) {
    text += "*ELSET,ELSET=S" + std::to_string(i) + "\n";
    for (int k = 0; k < 3; ++k) text += "S" + std::to_string(i - 1) + "\n";
  }
  EXPECT_EQ(deck(text).elements.size(), 2u);
  std::string chain = strip;
  for (int i = 0; i < 200; ++i) chain += "*ELSET,ELSET=S" + std::to_string(i) + "\nS" + std::to_string(i + 1) + "\n";
  EXPECT_THAT(deck_refusal(chain + "*ELSET,ELSET=S200\n1\n"), HasSubstr("more than 100 deep"));
}

TEST(InputRegions, are_the_sets_of_sections) {
  const MeshData data = deck(strip +
                             "*ELSET,ELSET=Left\n1\n*ELSET,ELSET=right\n2\n*ELSET,ELSET=all\nleft,right\n"
                             "*SHELL SECTION,ELSET=LEFT,MATERIAL=A\n1.\n*SHELL GENERAL SECTION,ELSET=right\n1.\n");
  EXPECT_THAT(regions(data), ElementsAre("Left", "right"));
  EXPECT_THAT(all_notes(data), HasSubstr("are no regions, because their elements belong to other regions: \"all\""));
  EXPECT_THAT(deck_refusal(strip + "*ELSET,ELSET=A\n1\n*ELSET,ELSET=B\n1,2\n*SHELL SECTION,ELSET=A\n1.\n"
                                   "*SHELL SECTION,ELSET=B\n1.\n"),
              HasSubstr("element 1 (line 9) lies in the sections of \"A\" and \"B\" (line 17)"));
}

TEST(InputRegions, are_also_the_sets_of_elements_without_a_section) {
  const std::string section = "*SHELL SECTION,ELSET=Left\n1.\n", left = "*ELSET,ELSET=Left\n1\n";
  EXPECT_THAT(regions(deck(strip + left + "*ELSET,ELSET=right\n2\n" + section)), ElementsAre("Left", "right"));
  EXPECT_THAT(regions(deck(strip + left + section)), ElementsAre("Left", "rest"));
  const MeshData both = deck(strip + left + "*ELSET,ELSET=both\n1,2\n" + section);
  EXPECT_THAT(regions(both), ElementsAre("Left", "rest"));
  EXPECT_THAT(all_notes(both), HasSubstr("because their elements belong to other regions: \"both\""));
}

TEST(InputRegions, are_otherwise_the_sets_of_element_blocks_then_those_that_do_not_overlap) {
  const std::string blocks = strip_nodes + "*ELEMENT,TYPE=S4,ELSET=a\n1,1,2,5,4\n*ELEMENT,TYPE=S4,ELSET=b\n2,2,3,6,5\n";
  const MeshData data = deck(blocks + "*ELSET,ELSET=c\n1\n");
  EXPECT_THAT(regions(data), ElementsAre("a", "b"));
  EXPECT_THAT(all_notes(data), HasSubstr("because their elements belong to other regions: \"c\""));
  EXPECT_THAT(regions(deck(strip + "*ELSET,ELSET=all\n1,2\n*ELSET,ELSET=l\n1\n*ELSET,ELSET=r\n2\n")),
              ElementsAre("l", "r"));
  EXPECT_THAT(regions(deck(strip + "*ELSET,ELSET=all\n1,2\n")), ElementsAre("all", "all"));
}

TEST(InputRegions, are_physical_groups_in_files_of_gmsh) {
  const MeshData data =
      deck(strip_nodes +
           "*ELEMENT,type=T3D2,ELSET=Line1\n11,1,4\n*ELEMENT,type=CPS4,ELSET=Surface1\n1,1,2,5,4\n"
           "*ELEMENT,type=CPS4,ELSET=Surface2\n2,2,3,6,5\n*ELSET,ELSET=clamped\n11\n*ELSET,ELSET=plate\n1,2\n");
  EXPECT_THAT(regions(data), ElementsAre("plate", "plate"));
  EXPECT_THAT(sides(data, "clamped"), ElementsAre("4-1"));
}

TEST(InputRegions, have_a_rest) {
  const MeshData data = deck(strip + "*ELSET,ELSET=rest\n1\n");
  EXPECT_THAT(regions(data), ElementsAre("rest", "rest_"));
  EXPECT_THAT(all_notes(data), HasSubstr("the region \"rest_\" has 1 element that no other region has"));
}

TEST(InputSurfaces, of_labels_of_either_program_name_sides) {
  const auto side = [](const std::string& type, const std::string& label) {
    return sides(
        deck(strip_nodes + "*ELEMENT,TYPE=" + type + "\n1,1,2,5,4\n2,2,3,6,5\n*SURFACE,NAME=s\n1," + label + "\n"),
        "s");
  };
  EXPECT_THAT(side("S4", "E1"), ElementsAre("1-2"));
  EXPECT_THAT(side("S4", "e2"), ElementsAre("2-5"));
  EXPECT_THAT(side("S4", "E4"), ElementsAre("4-1"));
  EXPECT_THAT(side("S4", "S3"), ElementsAre("1-2"));
  EXPECT_THAT(side("S4", "S6"), ElementsAre("4-1"));
  EXPECT_THAT(side("CPS4", "S1"), ElementsAre("1-2"));
  EXPECT_THAT(side("CPE4", "S4"), ElementsAre("4-1"));
  EXPECT_THAT(side("S4", "EDGE"), UnorderedElementsAre("1-2", "5-4", "4-1"));
  EXPECT_THAT(side("S4", "SNEG"), IsEmpty());
}

TEST(InputSurfaces, of_whole_sides_are_sets_of_elements) {
  for (const char* label : {"SPOS", "SNEG", "S1", "S2", ""})
    EXPECT_THAT(regions(deck(strip + "*SURFACE,NAME=wet,TYPE=ELEMENT\n2," + label + "\n")), ElementsAre("rest", "wet"));
}

TEST(InputSurfaces, of_nodes_name_sides) {
  EXPECT_THAT(sides(deck(strip + "*NSET,NSET=n\n1\n*SURFACE,NAME=s,TYPE=NODE\nn,1.\n4,1.\n"), "s"), ElementsAre("4-1"));
}

TEST(InputSurfaces, of_wrong_labels_are_refused) {
  EXPECT_THAT(deck_refusal(strip + "*SURFACE,NAME=s\n2,E5\n"),
              AllOf(HasSubstr("line 12"), HasSubstr("\"E5\" for element 2 of type S4"), HasSubstr("E1 to E4")));
  EXPECT_THAT(deck_refusal(strip + "*SURFACE,NAME=s\n9,E1\n"), AllOf(HasSubstr("line 12"), HasSubstr("no element 9")));
  EXPECT_THAT(all_notes(deck(strip + "*SURFACE,NAME=s,TYPE=CYLINDER\n0,0,0\n*SURFACE,NAME=t,COMBINE=UNION\ns\n")),
              HasSubstr("*SURFACE, COMBINE (1), *SURFACE, TYPE=CYLINDER (1)"));
}

TEST(InputNormals, stand_behind_coordinates_or_at_elements) {
  const MeshData data = deck(curved_deck);
  ASSERT_EQ(data.normals.size(), 9u);
  EXPECT_EQ(data.normals[0], Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(data.normals[2], Eigen::Vector3d(0, 0, 1));
  EXPECT_FALSE(data.normals[1] || data.normals[8]);
}

TEST(InputNormals, are_used_if_all_elements_at_a_node_agree) {
  const MeshData data =
      deck(strip + "*NSET,NSET=n\n2,5\n*NORMAL\n1,n,0,0,1\n2,2,0,0,1\n2,5,0,1,1\n1,4,0,0,1\n1,6,0,0,1\n");
  ASSERT_EQ(data.normals.size(), 6u);
  EXPECT_TRUE(data.normals[1]);   // both elements have it
  EXPECT_FALSE(data.normals[4]);  // different
  EXPECT_TRUE(data.normals[3]);   // one element
  EXPECT_FALSE(data.normals[5]);  // no node of element 1
  EXPECT_THAT(all_notes(data), HasSubstr("normals at 1 node are not used"));
  EXPECT_THAT(all_notes(deck(strip + "*NORMAL\n1,2,0,0,1\n")), HasSubstr("normals at 1 node are not used"));
  EXPECT_THAT(all_notes(deck(strip + "*NORMAL,TYPE=CONTACT SURFACE\ns,2,0,0,1\n")), HasSubstr("CONTACT SURFACE (1)"));
  EXPECT_THAT(deck_refusal(strip + "*NORMAL\n1,2,0,0,0\n"), AllOf(HasSubstr("line 12"), HasSubstr("length 0")));
}

TEST(InputNormals, of_elements_replace_those_of_the_node) {
  std::string text = strip + "*NORMAL\n1,1,0,3,4\n";
  text.replace(text.find("1,0,0\n"), 6, "1,0,0,0,0,0,1\n");
  const MeshData data = deck(text);
  ASSERT_EQ(data.normals.size(), 6u);
  EXPECT_LT((*data.normals[0] - Eigen::Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(InputFile, of_abaqus_cae_keeps_sets_of_part_and_assembly_apart) {
  const MeshData data = deck(cae_deck);
  EXPECT_EQ(data.nodes.size(), 6u);
  EXPECT_THAT(regions(data), ElementsAre("Set-1", "Set-1"));
  EXPECT_THAT(sides(data, "Set-1"), ElementsAre("4-1"));
  EXPECT_THAT(sides(data, "Panel-1.Set-1").size(), 6u);
  EXPECT_THAT(sides(data, "right"), ElementsAre("3-6"));
  EXPECT_THAT(sides(data, "Rim"), UnorderedElementsAre("1-2", "2-3"));
  EXPECT_THAT(all_notes(data), AllOf(HasSubstr("1 element of type MASS"), HasSubstr("1 node of the assembly"),
                                     HasSubstr("without a node of a shell: \"RP\"")));
}

TEST(InputFile, of_several_or_moved_instances_is_refused_with_the_way_out) {
  const std::string part = "*PART,NAME=P\n" + strip + "*END PART\n*ASSEMBLY,NAME=A\n*INSTANCE,NAME=I,PART=P\n";
  EXPECT_EQ(deck(part + "0.,0.,0.\n*END INSTANCE\n*END ASSEMBLY\n").elements.size(), 2u);
  EXPECT_THAT(deck_refusal(part + "1.,0.,0.\n*END INSTANCE\n"),
              AllOf(HasSubstr("moved or turned"), HasSubstr("without parts and assemblies")));
  EXPECT_THAT(deck_refusal(part + "*END INSTANCE\n*INSTANCE,NAME=J,PART=P\n*END INSTANCE\n"),
              AllOf(HasSubstr("second instance"), HasSubstr("Merge")));
  EXPECT_THAT(deck_refusal("*PART,NAME=P\n" + strip + "*END PART\n*PART,NAME=Q\n*NODE\n9,0,0\n*END PART\n"),
              AllOf(HasSubstr("\"part Q\""), HasSubstr("\"part P\"")));
  EXPECT_THAT(deck_refusal(part + "*END INSTANCE\n*NSET,NSET=A,INSTANCE=K\n1\n"),
              HasSubstr("\"K\", which does not exist"));
}

TEST(InputFile, names_what_it_does_not_read) {
  const MeshData data = deck(strip +
                             "*ELEMENT,TYPE=B31,ELSET=rib\n8,1,2\n9,4,5,99\n*ELEMENT,TYPE=SPRINGA\n10,1,2\n"
                             "*ELEMENT,TYPE=C3D20\n11,1,2,3,4,5,6,1,2,3,4,5,6,\n1,2,3,4,5,6,1,2\n"
                             "*BOUNDARY\n1,1,6\n*BOUNDARY\n2,1\n*SHELL SECTION,ELSET=rib,OFFSET=SPOS\n1.\n");
  EXPECT_EQ(sides(data, "rib").size(), 2u);
  EXPECT_THAT(data.notes, Contains(AllOf(HasSubstr("2 elements of type B31"), HasSubstr("(2 do)"))));
  EXPECT_THAT(data.notes, Contains("not read: 1 element of type SPRINGA, 1 of type C3D20: only shells are read"));
  EXPECT_THAT(data.notes,
              Contains("not read: *BOUNDARY (2), *SHELL SECTION (1): write materials, thickness, supports and "
                       "loads in the case file"));
  EXPECT_THAT(data.notes, Contains(AllOf(HasSubstr("OFFSET=SPOS"), HasSubstr("mid-surface"))));
}

TEST(InputFile, of_volumes_is_told_to_mesh_the_mid_surface) {
  std::string text = "*NODE\n1,0,0\n*ELEMENT,TYPE=C3D8R\n";
  for (int i = 1; i <= 1200; ++i) text += std::to_string(i) + ",1,1,1,1,1,1,1,1\n";
  EXPECT_THAT(deck_refusal(text), HasSubstr("it has 1200 elements of type C3D8R, which are volumes; a shell needs its "
                                            "mid-surface meshed with S4, S8, S3 or S6"));
  EXPECT_THAT(deck_refusal("*NODE\n1,0,0\n*ELEMENT,TYPE=MASS\n1,1\n"),
              AllOf(HasSubstr("no shell elements"), HasSubstr("1 element of type MASS")));
  EXPECT_THAT(deck_refusal("*HEADING\n"), HasSubstr("no nodes"));
}

TEST(InputFile, that_would_leave_the_mesh_incomplete_is_refused_by_keyword) {
  for (const char* keyword : {"INCLUDE, INPUT=mesh.inp", "SYSTEM", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"})
    EXPECT_THAT(deck_refusal(strip + "*" + keyword + "\n"), AllOf(HasSubstr("line 11"), HasSubstr("is not read")));
  EXPECT_THAT(deck_refusal("*Include, input=mesh.inp\n"), HasSubstr("put the whole mesh in one file"));
  EXPECT_THAT(deck_refusal("*NODE, INPUT=nodes.txt\n"), HasSubstr("another file"));
  EXPECT_THAT(deck_refusal("*NODE, SYSTEM=C\n1,1,90\n"), HasSubstr("rectangular"));
}

TEST(DamagedInputFile, is_refused_with_its_line_and_what_stands_there) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = strip;
    return deck_refusal(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_THAT(deck_refusal(""), HasSubstr("empty"));
  EXPECT_THAT(deck_refusal("$MeshFormat\n"),
              AllOf(HasSubstr("line 1"), HasSubstr("\"$MeshFormat\""), HasSubstr("*NODE")));
  EXPECT_THAT(changed("3,2,0", "3,two,0"), AllOf(HasSubstr("line 4"), HasSubstr("\"two\""), HasSubstr("coordinate")));
  EXPECT_THAT(changed("3,2,0", "3,nan,0"), HasSubstr("\"nan\""));
  EXPECT_THAT(changed("3,2,0", "3"), HasSubstr("node 3 has 0 numbers"));
  EXPECT_THAT(changed("3,2,0", "-3,2,0"), AllOf(HasSubstr("\"-3\""), HasSubstr("whole numbers from 1")));
  EXPECT_THAT(changed("3,2,0", "2,2,0"), HasSubstr("node 2 stands twice"));
  EXPECT_THAT(changed("1,2,5,4", "1,2,5"),
              AllOf(HasSubstr("line 10"), HasSubstr("element 1 has 8 nodes; the type S4 has 4")));
  EXPECT_THAT(changed("2,3,6,5", "2,3,6"), HasSubstr("the block ends after 3 of the 4 nodes of element 2 (line 10)"));
  EXPECT_THAT(changed("1,2,5,4", "1,2,5,9"), AllOf(HasSubstr("element 1 (line 9)"), HasSubstr("node 9")));
  EXPECT_THAT(changed("1,2,5,4", "1,2,5,5"), AllOf(HasSubstr("the node 5 twice"), HasSubstr("S3")));
  EXPECT_THAT(changed("2, 2,3", "1, 2,3"), HasSubstr("element 1 stands twice, in line 9 and in line 10"));
  EXPECT_THAT(changed("*ELEMENT, TYPE=S4", "*ELEMENT"), AllOf(HasSubstr("line 8"), HasSubstr("no parameter TYPE")));
  EXPECT_THAT(deck_refusal(strip + "*NSET\n1\n"), HasSubstr("no parameter NSET"));
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=\n1\n"), HasSubstr("name is empty"));
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=\x1b[2J\n1\n"), HasSubstr("cannot be printed"));
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=A,GENERATE\n5,1\n"), HasSubstr("not smaller"));
  EXPECT_THAT(deck_refusal(strip + "*NSET,NSET=A,GENERATE\n1,5,0\n"), HasSubstr("the step"));
}

TEST(DamagedInputFile, that_is_not_there_is_named) {
  try {
    read_inp_file("/no/such/panel.inp");
    FAIL();
  } catch (const mesh::DomainError& error) {
    EXPECT_STREQ(error.what(), "/no/such/panel.inp: there is no such input file");
  }
}

}  // namespace
}  // namespace plastron::domain
