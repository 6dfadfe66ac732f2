// Files whose cells are not a mesh of a plane domain. Each is refused with the elements and the place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/fem/surface.hpp>

#include <fmt/format.h>

#include "domain/written_mesh.hpp"

namespace plastron::domain {
namespace {

using namespace written;
using testing::AllOf;
using testing::HasSubstr;

struct Node {
  double x, y;
};

/// A file of format 2.2: nodes are numbered from 1, an element is "type nodes...", curves are in group 1, cells in 2.
std::string file_of(const std::vector<Node>& nodes, const std::vector<std::string>& elements, double scale = 1) {
  std::string text = header + names + fmt::format("$Nodes\n{}\n", nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    text += fmt::format("{} {} {} 0\n", i + 1, scale * nodes[i].x, scale * nodes[i].y);
  text += fmt::format("$EndNodes\n$Elements\n{}\n", elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::size_t blank = elements[i].find(' ');
    const std::string type = elements[i].substr(0, blank);
    text += fmt::format("{} {} 1 {}{}\n", i + 1, type, type == "1" || type == "8" ? 1 : 2, elements[i].substr(blank));
  }
  return text + "$EndElements\n";
}

const std::vector<double> scales{1e-12, 1e-6, 1, 1e6};

// 7 8 9
// 4 5 6
// 1 2 3, and 10 above 7, 11 above 9
const std::vector<Node> grid{{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}, {0, 3}, {2, 3}};

TEST(Mesh, of_four_squares_is_accepted_in_every_unit_of_length) {
  for (const double scale : scales) {
    const mesh::CoarseMesh mesh = read_text(file_of(grid, {"3 1 2 5 4", "3 2 3 6 5", "3 4 5 8 7", "3 5 6 9 8"}, scale));
    EXPECT_EQ(mesh.cells.size(), 4u);
  }
}

TEST(Mesh, with_a_hanging_node_is_refused) {
  for (const double scale : scales) {
    const std::string message = refusal(file_of(grid, {"3 4 5 8 7", "3 5 6 9 8", "3 7 9 11 10"}, scale));
    EXPECT_THAT(message, AllOf(HasSubstr("hanging node"), HasSubstr("element 3 (line 27)"),
                               HasSubstr(fmt::format("({:.6g}, {:.6g})", scale, 2 * scale))));
  }
  EXPECT_THAT(refusal(file_of(grid, {"2 4 5 7", "2 5 6 8", "2 5 8 7", "2 6 9 8", "2 7 9 10"}), mesh::Shape::triangle),
              HasSubstr("hanging node"));
}

// The long side is a parabola with the sagitta 1/2. The hanging corner (1, 2.5) is its top.
TEST(Mesh, with_a_hanging_node_on_a_curved_side_is_refused) {
  const std::vector<Node> nodes{{0, 0},   {2, 0}, {2, 2},   {0, 2}, {1, 0}, {2, 1},
                                {1, 2.5}, {0, 1}, {1, 1.1}, {0, 4}, {1, 4}, {2, 4}};
  const std::vector<std::string> curved{"10 1 2 3 4 5 6 7 8 9", "3 4 7 11 10", "3 7 3 12 11"};
  EXPECT_THAT(refusal(file_of(nodes, curved)), AllOf(HasSubstr("hanging node"), HasSubstr("(1, 2.5)")));
}

TEST(Mesh, that_lists_a_cell_twice_is_refused) {
  for (const char* again : {"3 1 2 5 4", "3 5 4 1 2", "3 4 5 2 1"})
    EXPECT_THAT(
        refusal(file_of(grid, {"3 1 2 5 4", again})),
        AllOf(HasSubstr("element 1 (line 25) and element 2 (line 26) are the same cell"), HasSubstr("(0.5, 0.5)")));
  EXPECT_THAT(refusal(file_of(grid, {"2 1 2 5", "2 5 2 1"}), mesh::Shape::triangle), HasSubstr("the same cell"));
}

TEST(Mesh, with_three_cells_at_one_side_is_refused) {
  EXPECT_THAT(refusal(file_of(grid, {"3 1 2 5 4", "3 4 5 8 7", "3 4 5 9 7"})),
              AllOf(HasSubstr("3 cells meet"), HasSubstr("(0, 1)"), HasSubstr("(1, 1)"), HasSubstr("element 3")));
}

TEST(Mesh, with_overlapping_cells_is_refused) {
  for (const double scale : scales) {
    EXPECT_THAT(refusal(file_of(grid, {"3 1 2 5 4", "3 1 2 8 7"}, scale)), HasSubstr("overlap"));
    const std::vector<Node> apart{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {.5, .5}, {1.2, .5}, {1.2, 1.2}, {.5, 1.2}};
    EXPECT_THAT(refusal(file_of(apart, {"3 1 2 3 4", "3 5 6 7 8"}, scale)), HasSubstr("overlap"));
  }
}

TEST(Mesh, with_a_cell_that_is_not_convex_or_folded_is_refused_with_its_place) {
  const std::vector<Node> nodes{{0, 0}, {2, 0}, {.5, .5}, {0, 2}, {2, 2}, {1, 0}, {4, 0}};
  for (const double scale : scales) {
    EXPECT_THAT(refusal(file_of(nodes, {"3 1 2 3 4"}, scale)),
                AllOf(HasSubstr("element 1 (line 21)"), HasSubstr("folds over or is degenerate"),
                      HasSubstr(fmt::format("x = {:.6g}", scale * .5))));
    refusal(file_of(nodes, {"3 1 2 4 5"}, scale));                       // sides cross
    refusal(file_of(nodes, {"3 1 6 2 4"}, scale));                       // a corner of 180 degrees
    refusal(file_of(nodes, {"3 1 2 2 4"}, scale));                       // two equal corners
    refusal(file_of(nodes, {"2 1 6 7"}, scale), mesh::Shape::triangle);  // no area
  }
}

// The middle node of a side lies beyond a quarter of its length, so the map folds.
TEST(Mesh, with_a_curved_cell_that_folds_is_refused) {
  const std::vector<Node> nodes{{0, 0}, {1, 0}, {0, 1}, {.9, 0}, {.5, .5}, {0, .5}};
  EXPECT_THAT(refusal(file_of(nodes, {"9 1 2 3 4 5 6"}), mesh::Shape::triangle), HasSubstr("folds over"));
}

TEST(Mesh, with_a_named_line_that_is_no_side_of_a_cell_is_refused) {
  EXPECT_THAT(refusal(file_of(grid, {"1 1 3", "3 1 2 5 4", "3 2 3 6 5"})),
              AllOf(HasSubstr("element 1 (line 25)"), HasSubstr("(0, 0)"), HasSubstr("(2, 0)"), HasSubstr("\"edge\"")));
  EXPECT_THAT(refusal(file_of(grid, {"1 8 9", "3 1 2 5 4"})), HasSubstr("no side of a cell"));
}

TEST(Mesh, with_a_cell_outside_of_all_regions_is_refused) {
  std::string text = file_of(grid, {"3 1 2 5 4", "3 2 3 6 5"});
  text.replace(text.find("2 3 1 2 2 3 6 5"), 15, "2 3 1 0 2 3 6 5");
  EXPECT_THAT(refusal(text), AllOf(HasSubstr("element 2 (line 26)"), HasSubstr("no physical surface")));
}

TEST(Point, is_found_in_every_unit_of_length) {
  for (const double scale : scales) {
    const mesh::CoarseMesh disk =
        coarse_mesh(Disk{.centre = {3 * scale, 0}, .radius = scale}, mesh::Shape::quadrilateral);
    for (const double inside : {0.0, 0.3, 0.9, 1.0})
      EXPECT_TRUE(fem::locate(disk, {(3 + 0.6 * inside) * scale, 0.8 * inside * scale})) << scale << " " << inside;
    for (const double outside : {1.0001, 1.5, 40.0})
      EXPECT_FALSE(fem::locate(disk, {(3 + 0.6 * outside) * scale, 0.8 * outside * scale})) << scale << " " << outside;
  }
}

TEST(Polygon, is_meshed_alike_in_every_unit_of_length) {
  const auto cells = [](double scale) {
    std::vector<Vector2d> corners{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (Vector2d& c : corners) c *= scale;
    return coarse_mesh(Polygon{corners}, mesh::Shape::quadrilateral).cells.size();
  };
  for (const double scale : scales) EXPECT_EQ(cells(scale), cells(1)) << scale;
}

}  // namespace
}  // namespace plastron::domain
