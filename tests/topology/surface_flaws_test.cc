// Surface meshes with flaws, each found with its elements and its place; and sound ones without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/topology/cell_facets.hpp>
#include <plastron/topology/surface_flaws.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "topology/space_meshes.hpp"

namespace plastron::topology::space_meshes {

using Eigen::Vector2d;
namespace {

using testing::AllOf;
using testing::HasSubstr;

void expect_sound(const SpaceMesh& mesh, const FlawLimits& limits = {}) {
  const SurfaceFlaws flaws = find_flaws(mesh, limits);
  for (const Flaw& f : flaws.errors) ADD_FAILURE() << f.message;
  for (const Flaw& f : flaws.warnings) ADD_FAILURE() << f.message;
}

std::string only(const std::vector<Flaw>& flaws) {
  std::string all;
  for (const Flaw& f : flaws) all += f.message + "\n";
  EXPECT_EQ(flaws.size(), 1u) << all;
  return all;
}
std::string only_error(const SpaceMesh& mesh) {
  const SurfaceFlaws flaws = find_flaws(mesh, {});
  for (const Flaw& f : flaws.warnings) ADD_FAILURE() << f.message;
  return only(flaws.errors);
}
std::string only_warning(const SpaceMesh& mesh, const FlawLimits& limits = {}) {
  const SurfaceFlaws flaws = find_flaws(mesh, limits);
  for (const Flaw& f : flaws.errors) ADD_FAILURE() << f.message;
  return only(flaws.warnings);
}

/// A mesh of plates, each a grid with its own nodes.
struct Plate {
  Grid grid;
  Vector3d corner, side_1, side_2;
};
SpaceMesh plates(mesh::Shape shape, const std::vector<Plate>& all) {
  SpaceMesh mesh{.shape = shape, .nodes = {}, .cells = {}};
  for (const Plate& p : all) add_grid(p.grid, plate(p.corner, p.side_1, p.side_2), mesh);
  return mesh;
}

TEST(SoundMesh, has_no_flaws) {
  for (const mesh::Shape shape : shapes) {
    const FlawLimits limits{.thickness = {0.2}};
    for (const int order : {1, 2, 3}) {
      expect_sound(cube(shape, 3, order), limits);
      expect_sound(sphere(shape, 6, order), limits);
      expect_sound(torus(shape, {24, 12, order}), limits);
      expect_sound(tube(shape, {16, 3, order}), limits);
      expect_sound(twisted_strip(shape, {24, 2, order}, 2), limits);
    }
    // Elements are smaller than the thickness.
    expect_sound(star(shape, 10, 1, {0, pi / 2, pi, 1.5 * pi}), limits);
    expect_sound(star(shape, 10, 1, {0, 0.6 * pi}), limits);
  }
}

TEST(Gap, between_borders_is_found_with_its_distance_and_the_tolerance_that_closes_it) {
  for (const mesh::Shape shape : shapes)
    for (const double angle : {0.0, 1.0, 1.5, 2.5})
      for (const double unit : {1e-3, 1.0, 1e3}) {
        SpaceMesh mesh = plates(shape, {{{3, 3}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}},
                                        {{3, 3}, {1e-4, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, {0, 1, 0}}});
        for (Vector3d& x : mesh.nodes) x *= unit;
        const std::string message = only_error(mesh);
        EXPECT_THAT(message, AllOf(HasSubstr("number 3"), HasSubstr(fmt::format("{:.3g}", 1e-4 * unit)),
                                   HasSubstr("Coherence"), HasSubstr("element 1")));
        const std::size_t at = message.find("tolerance to ") + 13;
        const SpaceMesh joined = merge_nodes(mesh, std::stod(message.substr(at))).mesh;
        expect_sound(joined);
        EXPECT_EQ(joined.nodes.size() + 4, mesh.nodes.size());
      }
}

TEST(Gap, to_an_inner_edge_is_found) {
  for (const mesh::Shape shape : shapes)
    EXPECT_THAT(
        only_error(
            plates(shape, {{{4, 4}, {-1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{2, 4}, {0, 0, 1e-4}, {0, 0, 1}, {0, 1, 0}}})),
        AllOf(HasSubstr("without being joined"), HasSubstr("0.0001"), HasSubstr("set the tolerance to 0.00011")));
}

TEST(Borders, one_above_the_other_or_far_apart_are_no_gap) {
  for (const mesh::Shape shape : shapes) {
    expect_sound(
        plates(shape, {{{3, 3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{3, 3}, {0, 0, 0.01}, {1, 0, 0}, {0, 1, 0}}}));
    expect_sound(
        plates(shape, {{{3, 3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{4, 5}, {.1, .1, .01}, {1, 0, 0}, {0, 1, 0}}}));
    expect_sound(
        plates(shape, {{{3, 3}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}}, {{3, 3}, {0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
  }
}

TEST(HangingNode, is_found) {
  for (const mesh::Shape shape : shapes)
    for (const double gap : {0.0, 1e-4}) {
      const SpaceMesh mesh = glued(
          plates(shape, {{{1, 2}, {0, 0, 0}, {-1, 0, 0}, {0, 2, 0}}, {{2, 4}, {gap, 0, 0}, {1, 0, 0}, {0, 2, 0}}}));
      EXPECT_THAT(only_error(mesh), AllOf(HasSubstr("inside of a side"), HasSubstr("number 2"),
                                          HasSubstr("whole sides"), HasSubstr(fmt::format("({:.6g}, 1.5, 0)", gap))));
    }
}

TEST(HangingNode, on_a_curved_side_of_straight_elements_is_found) {
  SpaceMesh mesh{.nodes = {}, .cells = {}};
  for (const int part : {0, 1})
    add_grid(
        {12 << part, 2, 1},
        [&](double s, double t) { return Vector3d(std::cos(2 * s), std::sin(2 * s), part == 0 ? t : -t); }, mesh);
  EXPECT_THAT(only_error(glued(mesh)), AllOf(HasSubstr("inside of a side"), HasSubstr("number 12")));
}

TEST(Rib, that_ends_on_a_plate_without_an_edge_is_found) {
  for (const mesh::Shape shape : shapes)
    for (const double gap : {0.0, 1e-3}) {
      const SpaceMesh mesh = plates(shape, {{{3, 3}, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                                            {{2, 2}, {0.1, -0.2, gap}, {0.05, 0.35, 0}, {0.1, 0, 1}}});
      EXPECT_THAT(only_error(mesh),
                  AllOf(HasSubstr("inside of another element"), HasSubstr("number 3"), HasSubstr("imprint")));
    }
}

TEST(Duplicates, are_found) {
  for (const mesh::Shape shape : shapes) {
    SpaceMesh mesh = plates(shape, {{{3, 3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    mesh.cells.push_back(turned(shape, mesh.cells[4]));
    mesh.cells.back().tag = 77;
    EXPECT_THAT(only_error(mesh), AllOf(HasSubstr("same corners"), HasSubstr("element 5"), HasSubstr("element 77")));
  }
}

TEST(FoldedAndDegenerateCells, are_found) {
  SpaceMesh concave{.nodes = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}},
                    .cells = {{.nodes = {0, 1, 2, 3}, .tag = 8}}};
  EXPECT_THAT(only_error(concave), AllOf(HasSubstr("element 8"), HasSubstr("folds over"), HasSubstr("(0.5, 0.5, 0)")));
  SpaceMesh crossed{.nodes = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                    .cells = {{.nodes = {0, 1, 2, 3}, .tag = 8}}};
  EXPECT_THAT(only_error(crossed), HasSubstr("folds over"));
  SpaceMesh line{.shape = mesh::Shape::triangle,
                 .nodes = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}},
                 .cells = {{.nodes = {0, 1, 2}, .tag = 8}}};
  EXPECT_THAT(only_error(line), HasSubstr("element 8"));
  // The middle node of a side lies beyond a quarter of its length.
  SpaceMesh curved{.shape = mesh::Shape::triangle,
                   .nodes = {{0, 0, 0}, {.9, 0, 0}, {1, 0, 0}, {0, .5, 0}, {.5, .5, 0}, {0, 1, 0}},
                   .cells = {{.nodes = {0, 1, 2, 3, 4, 5}, .order = 2, .tag = 8}}};
  EXPECT_THAT(only_error(curved), HasSubstr("element 8"));
  // The middle node lies at a quarter of the side: a_1 vanishes at a corner.
  curved.nodes[1] = {.75, 0, 0};
  EXPECT_THAT(only_error(curved), AllOf(HasSubstr("element 8"), HasSubstr("(1, 0, 0)")));
  SpaceMesh broken = concave;
  broken.nodes[2][1] = NAN;
  EXPECT_THAT(only_error(broken), HasSubstr("finite"));
}

TEST(Slivers, are_warned_of) {
  for (const mesh::Shape shape : shapes)
    EXPECT_THAT(only_warning(plates(shape, {{{2, 1}, {0, 0, 0}, {1e4, 0, 0}, {0, 1, 0}}})),
                AllOf(HasSubstr("the worst of"), HasSubstr("longer than wide"), HasSubstr("5000")));
  SpaceMesh uneven{.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5001, 0.5001, 0}},
                   .cells = {{.nodes = {0, 1, 2, 3}, .tag = 8}}};
  EXPECT_THAT(only_warning(uneven), AllOf(HasSubstr("element 8"), HasSubstr("nearly degenerate")));
}

TEST(Surfaces, that_pass_through_each_other_are_warned_of) {
  for (const mesh::Shape shape : shapes)
    EXPECT_THAT(only_warning(plates(shape, {{{3, 3}, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                                            {{2, 2}, {0.1, -0.2, -0.4}, {0.05, 0.35, 0}, {0.1, 0, 1}}})),
                AllOf(HasSubstr("passes through itself"), HasSubstr(", 0)")));
}

TEST(Surfaces, nearer_than_their_thickness_are_warned_of) {
  for (const mesh::Shape shape : shapes) {
    SpaceMesh mesh =
        plates(shape, {{{3, 3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{4, 4}, {0, 0.1, 0.03}, {1, 0, 0.02}, {0, 1, 0}}});
    for (std::size_t c = mesh.cells.size() / 2; c < mesh.cells.size(); ++c) mesh.cells[c].region = 1;
    EXPECT_THAT(only_warning(mesh, {.thickness = {0.04, 0.04}}), AllOf(HasSubstr("nearer"), HasSubstr("0.03 apart")));
    expect_sound(mesh, {.thickness = {0.02, 0.02}});
  }
}

TEST(Flaws, do_not_depend_on_the_order_of_nodes_and_cells) {
  const SpaceMesh mesh = plates(mesh::Shape::quadrilateral, {{{3, 3}, {0, 0, 0}, {-1, 0, 0}, {0, 1, 0}},
                                                             {{3, 3}, {1e-4, 0, 0}, {1, 0, 1e-3}, {0, 1, 0}}});
  const SurfaceFlaws flaws = find_flaws(mesh, {});
  for (unsigned seed = 1; seed < 5; ++seed) {
    const SurfaceFlaws other = find_flaws(shuffled(mesh, seed), {});
    ASSERT_EQ(other.errors.size(), flaws.errors.size());
    EXPECT_EQ(other.warnings.size(), flaws.warnings.size());
    EXPECT_THAT(other.errors[0].message, AllOf(HasSubstr("number 3"), HasSubstr("tolerance to 0.00011")));
  }
}

TEST(DamagedMesh, gives_flaws_with_finite_places) {
  std::mt19937 random(12);
  std::size_t found = 0;
  for (int i = 0; i < 500; ++i) {
    const mesh::Shape shape = shapes[random() % 2];
    const int order = 1 + static_cast<int>(random() % 3);
    SpaceMesh mesh = random() % 2 == 0 ? star(shape, 2, order, {0, 1.5, 3, 4}) : tube(shape, {5, 2, order});
    for (auto n = 1 + random() % 6; n > 0; --n) damage(mesh, random);
    const SurfaceFlaws flaws = find_flaws(mesh, {.thickness = {0.3}});
    found += flaws.errors.size() + flaws.warnings.size();
    for (const auto* list : {&flaws.errors, &flaws.warnings})
      for (const Flaw& f : *list) EXPECT_TRUE(f.where.allFinite()) << f.message;
  }
  EXPECT_GT(found, 100u);
}

TEST(NearestPoint, of_a_triangle_is_nearer_than_all_its_other_points) {
  const std::array<Vector3d, 3> triangle{Vector3d(0, 0, 0), Vector3d(1, 0.2, 0), Vector3d(0.3, 0.8, 0.5)};
  std::mt19937 random(5);
  const auto number = [&] { return 4 * static_cast<double>(random()) / 4294967296.0 - 2; };
  for (int i = 0; i < 200; ++i) {
    const Vector3d x(number(), number(), number());
    const double d = (nearest_point(triangle, x) - x).norm();
    double least = HUGE_VAL;
    for (const Vector2d& p : mesh::lattice(mesh::Shape::triangle, 60))
      least = std::min(
          least, (triangle[0] + p[0] * (triangle[1] - triangle[0]) + p[1] * (triangle[2] - triangle[0]) - x).norm());
    EXPECT_LE(d, least + 1e-12);
    EXPECT_GT(d, least - 0.01);
  }
}

TEST(BoxTree, visits_all_boxes_that_meet_a_box_once) {
  std::mt19937 random(5);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<SpaceBox> boxes(300);
  for (SpaceBox& b : boxes) {
    b.add(Vector3d(number(), number(), number()));
    b.add(Vector3d(b.low + 0.1 * Vector3d(number(), number(), number())));
  }
  const BoxTree tree(boxes);
  for (int i = 0; i < 50; ++i) {
    const SpaceBox wanted = boxes[i].widened(0.1 * number());
    std::vector<int> visits(boxes.size());
    tree.visit(wanted, [&](std::size_t b) { ++visits[b]; });
    for (std::size_t b = 0; b < boxes.size(); ++b) EXPECT_EQ(visits[b], boxes[b].meets(wanted) ? 1 : 0);
  }
}

}  // namespace
}  // namespace plastron::topology::space_meshes
