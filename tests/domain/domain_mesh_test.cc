// The coarsest meshes of the domains that a case can name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/domain/domain_mesh.hpp>

#include <cmath>
#include <numbers>
#include <set>

#include "fem/mesh_measure.hpp"

namespace plastron::domain {
namespace {

using std::numbers::pi;
using testing::ElementsAre;

/// Length of the edges of each boundary, along straight lines.
std::map<std::string, double> chords(const mesh::CoarseMesh& mesh) {
  std::map<std::string, double> lengths;
  for (const mesh::BoundaryEdge& e : mesh.edges)
    lengths[mesh.boundaries[static_cast<std::size_t>(e.boundary)]] +=
        (mesh.vertices[static_cast<std::size_t>(e.vertices[0])] -
         mesh.vertices[static_cast<std::size_t>(e.vertices[1])])
            .norm();
  return lengths;
}

TEST(Rectangle, is_cut_into_the_cells_asked_for) {
  const mesh::CoarseMesh mesh =
      coarse_mesh(Rectangle{.from = {-1, 2}, .to = {2, 4}, .cells = {3, 5}}, mesh::Shape::quadrilateral);
  fem::expect_cells_fit(mesh);
  EXPECT_EQ(mesh.cells.size(), 15u);
  EXPECT_EQ(mesh.vertices.size(), 24u);
  EXPECT_NEAR(fem::area(mesh), 6, 1e-14);
  EXPECT_THAT(mesh.boundaries, ElementsAre("left", "right", "bottom", "top"));
  auto lengths = chords(mesh);
  EXPECT_NEAR(lengths["left"], 2, 1e-14);
  EXPECT_NEAR(lengths["right"], 2, 1e-14);
  EXPECT_NEAR(lengths["bottom"], 3, 1e-14);
  EXPECT_NEAR(lengths["top"], 3, 1e-14);
}

TEST(Rectangle, has_its_boundaries_where_their_names_say) {
  const mesh::CoarseMesh mesh =
      coarse_mesh(Rectangle{.from = {-1, 2}, .to = {2, 4}, .cells = {3, 5}}, mesh::Shape::quadrilateral);
  const int axis[4] = {0, 0, 1, 1};
  const double at[4] = {-1, 2, 2, 4};
  for (const mesh::BoundaryEdge& e : mesh.edges)
    for (const int v : e.vertices)
      EXPECT_EQ(mesh.vertices[static_cast<std::size_t>(v)][axis[e.boundary]], at[e.boundary]);
}

TEST(Rectangle, without_cells_gets_square_ones_but_not_too_many) {
  EXPECT_EQ(coarse_mesh(Rectangle{}, mesh::Shape::quadrilateral).cells.size(), 1u);
  EXPECT_EQ(coarse_mesh(Rectangle{.to = {3, 1}}, mesh::Shape::quadrilateral).cells.size(), 3u);
  EXPECT_EQ(coarse_mesh(Rectangle{.to = {1, 4.2}}, mesh::Shape::quadrilateral).cells.size(), 4u);
  EXPECT_EQ(coarse_mesh(Rectangle{.to = {100, 1}}, mesh::Shape::quadrilateral).cells.size(), 8u);
}

TEST(Rectangle, of_regions_has_a_line_of_the_mesh_at_every_break) {
  const Rectangle rectangle{.to = {3, 1}, .cells = {6, 1}, .breaks = {0.7, 1.9}, .regions = {"a", "b", "c"}};
  const mesh::CoarseMesh mesh = coarse_mesh(rectangle, mesh::Shape::quadrilateral);
  fem::expect_cells_fit(mesh);
  EXPECT_THAT(mesh.regions, ElementsAre("a", "b", "c"));
  EXPECT_NEAR(fem::area(mesh), 3, 1e-14);
  const double ends[4] = {0, 0.7, 1.9, 3};
  for (const mesh::CoarseCell& cell : mesh.cells) {
    EXPECT_GE(cell.map({0, 0}).value[0], ends[cell.region]);
    EXPECT_LE(cell.map({1, 0}).value[0], ends[cell.region + 1]);
  }
}

TEST(Disk, has_its_exact_area_and_its_rim_is_round) {
  const Disk disk{.centre = {1, -2}, .radius = 0.7};
  const mesh::CoarseMesh mesh = coarse_mesh(disk, mesh::Shape::quadrilateral);
  fem::expect_cells_fit(mesh);
  EXPECT_NEAR(fem::area(mesh), pi * 0.49, 1e-13);
  EXPECT_THAT(mesh.boundaries, ElementsAre("rim"));
  EXPECT_EQ(mesh.edges.size(), 4u);
  for (std::size_t c = 1; c < mesh.cells.size(); ++c)
    for (const double t : {0.0, 0.1, 0.5, 0.8, 1.0})
      EXPECT_NEAR((mesh.cells[c].map({1, t}).value - disk.centre).norm(), disk.radius, 1e-15);
}

TEST(Annulus, has_its_exact_area_and_both_its_boundaries_are_round) {
  for (const double inner : {0.05, 0.5, 0.97}) {
    const Annulus annulus{.centre = {1, -2}, .inner = inner, .outer = 1};
    const mesh::CoarseMesh mesh = coarse_mesh(annulus, mesh::Shape::quadrilateral);
    fem::expect_cells_fit(mesh);
    EXPECT_NEAR(fem::area(mesh), pi * (1 - inner * inner), 1e-13);
    EXPECT_THAT(mesh.boundaries, ElementsAre("inner", "outer"));
    EXPECT_EQ(mesh.edges.size(), 2 * mesh.cells.size());
    for (const mesh::CoarseCell& cell : mesh.cells)
      for (const double t : {0.0, 0.3, 1.0}) {
        EXPECT_NEAR((cell.map({0, t}).value - annulus.centre).norm(), inner, 1e-15);
        EXPECT_NEAR((cell.map({1, t}).value - annulus.centre).norm(), 1, 1e-15);
      }
    for (const mesh::BoundaryEdge& e : mesh.edges)
      for (const int v : e.vertices)
        EXPECT_NEAR((mesh.vertices[static_cast<std::size_t>(v)] - annulus.centre).norm(), e.boundary == 0 ? inner : 1,
                    1e-15);
  }
}

struct NamedPolygon {
  std::string name;
  std::vector<Vector2d> corners;
  double area;
};

std::vector<NamedPolygon> polygons() {
  return {{"convex quadrilateral", {{0, 0}, {2, 0.2}, {1.5, 1.4}, {-0.3, 1}}, 2.21},
          {"triangle", {{0, 0}, {2, 0}, {0.5, 1.5}}, 1.5},
          {"L", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 3},
          {"arrow", {{0, 0}, {2, -1}, {1, 0}, {2, 1}}, 1},
          {"quadrilateral with a straight corner", {{0, 0}, {1, 0}, {2, 0}, {1, 1}}, 1},
          {"hexagon", {{1, 0}, {0.5, 0.866}, {-0.5, 0.866}, {-1, 0}, {-0.5, -0.866}, {0.5, -0.866}}, 2.598}};
}

void expect_polygon(const std::vector<Vector2d>& corners, double expected_area) {
  const mesh::CoarseMesh mesh = coarse_mesh(Polygon{corners}, mesh::Shape::quadrilateral);
  fem::expect_cells_fit(mesh);
  EXPECT_NEAR(fem::area(mesh), expected_area, 1e-13);
  EXPECT_THAT(mesh.regions, ElementsAre(""));
  ASSERT_EQ(mesh.boundaries.size(), corners.size());
  auto lengths = chords(mesh);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::string name = "edge" + std::to_string(i + 1);
    const Vector2d a = corners[i], b = corners[(i + 1) % corners.size()];
    EXPECT_EQ(mesh.boundaries[i], name);
    EXPECT_NEAR(lengths[name], (b - a).norm(), 1e-12) << name;
    for (const mesh::BoundaryEdge& e : mesh.edges)
      if (e.boundary == static_cast<int>(i))
        for (const int v : e.vertices) {
          const Vector2d d = mesh.vertices[static_cast<std::size_t>(v)] - a;
          EXPECT_NEAR(d[0] * (b - a)[1] - d[1] * (b - a)[0], 0, 1e-12) << name;
        }
  }
}

TEST(Polygon, has_its_area_and_its_edges_in_the_order_of_its_corners) {
  for (const auto& [name, corners, area] : polygons()) {
    SCOPED_TRACE(name);
    expect_polygon(corners, area);
  }
}

TEST(Polygon, may_be_drawn_clockwise) {
  for (const auto& [name, corners, area] : polygons()) {
    SCOPED_TRACE(name);
    expect_polygon({corners.rbegin(), corners.rend()}, area);
  }
}

TEST(Polygon, that_is_a_convex_quadrilateral_is_one_cell) {
  EXPECT_EQ(coarse_mesh(Polygon{polygons()[0].corners}, mesh::Shape::quadrilateral).cells.size(), 1u);
  EXPECT_GT(coarse_mesh(Polygon{polygons()[3].corners}, mesh::Shape::quadrilateral).cells.size(), 1u);
}

TEST(Polygon, gets_the_same_mesh_every_time) {  // examine() and solve() each make its mesh
  for (const auto& [name, corners, area] : polygons()) {
    SCOPED_TRACE(name);
    const mesh::CoarseMesh first = coarse_mesh(Polygon{corners}, mesh::Shape::quadrilateral),
                           second = coarse_mesh(Polygon{corners}, mesh::Shape::quadrilateral);
    ASSERT_EQ(first.vertices.size(), second.vertices.size());
    for (std::size_t i = 0; i < first.vertices.size(); ++i) EXPECT_EQ(first.vertices[i], second.vertices[i]);
    ASSERT_EQ(first.cells.size(), second.cells.size());
    for (std::size_t c = 0; c < first.cells.size(); ++c) EXPECT_EQ(first.cells[c].vertices, second.cells[c].vertices);
  }
}

TEST(Polygon, that_is_small_is_meshed_like_a_large_one) {
  const auto scaled = [](double factor) {
    std::vector<Vector2d> corners = polygons()[1].corners;
    for (Vector2d& c : corners) c *= factor;
    return coarse_mesh(Polygon{corners}, mesh::Shape::quadrilateral);
  };
  const std::size_t cells = scaled(1).cells.size();
  EXPECT_EQ(scaled(1.0 / 1024).cells.size(), cells);
  EXPECT_EQ(scaled(1024).cells.size(), cells);
}

/// Gmsh fails at the crossing. The case file's reader refuses such polygons before, but rows along sides may cross too.
TEST(Polygon, whose_sides_cross_is_refused_with_the_words_of_gmsh) {
  const Polygon crossed{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
  for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    std::string message;
    try {
      coarse_mesh(crossed, shape);
    } catch (const mesh::DomainError& error) {
      message = error.what();
    }
    EXPECT_THAT(message, testing::StartsWith("polygon: Gmsh cannot mesh it: Unable to recover the edge"));
  }
  EXPECT_GT(coarse_mesh(Polygon{polygons()[3].corners}, mesh::Shape::quadrilateral).cells.size(), 1u);
}

// ---- triangles -----------------------------------------------------------------------------------------------------

TEST(Triangles, of_a_domain_are_its_quadrilaterals_cut_crosswise) {
  const Rectangle regions{.to = {3, 1}, .cells = {3, 1}, .breaks = {1}, .regions = {"flat", "round"}};
  for (const Domain& domain : std::vector<Domain>{Rectangle{}, regions, Disk{.radius = 2}, Annulus{}}) {
    const mesh::CoarseMesh whole = coarse_mesh(domain, mesh::Shape::quadrilateral),
                           cut = coarse_mesh(domain, mesh::Shape::triangle);
    EXPECT_EQ(cut.shape, mesh::Shape::triangle);
    fem::expect_cells_fit(cut);
    EXPECT_EQ(cut.cells.size(), 4 * whole.cells.size());
    EXPECT_NEAR(fem::area(cut), fem::area(whole), 1e-13);
    EXPECT_EQ(cut.boundaries, whole.boundaries);
    EXPECT_EQ(chords(cut), chords(whole));
    for (const mesh::CoarseCell& c : cut.cells) EXPECT_EQ(c.vertices[3], -1);
  }
  for (const mesh::CoarseCell& c : coarse_mesh(regions, mesh::Shape::triangle).cells)
    EXPECT_EQ(c.region, c.map(mesh::centre(mesh::Shape::triangle)).value[0] < 1 ? 0 : 1);
}

// A triangle with all its vertices on a clamped boundary could not bend at all.
TEST(Triangles, of_a_built_in_domain_have_a_vertex_inside) {
  for (const Domain& domain : std::vector<Domain>{Rectangle{}, Disk{}, Annulus{}, Polygon{polygons()[0].corners}}) {
    const mesh::CoarseMesh mesh = coarse_mesh(domain, mesh::Shape::triangle);
    std::set<int> outside;
    for (const mesh::BoundaryEdge& e : mesh.edges) outside.insert(e.vertices.begin(), e.vertices.end());
    for (const mesh::CoarseCell& c : mesh.cells)
      EXPECT_FALSE(outside.contains(c.vertices[0]) && outside.contains(c.vertices[1]) &&
                   outside.contains(c.vertices[2]));
  }
}

TEST(Triangles, of_polygons_fill_them) {
  for (const auto& polygon : polygons()) {
    const mesh::CoarseMesh mesh = coarse_mesh(Polygon{polygon.corners}, mesh::Shape::triangle);
    EXPECT_EQ(mesh.shape, mesh::Shape::triangle);
    fem::expect_cells_fit(mesh);
    EXPECT_NEAR(fem::area(mesh), fem::area(coarse_mesh(Polygon{polygon.corners}, mesh::Shape::quadrilateral)), 1e-12);
    EXPECT_EQ(mesh.regions, std::vector<std::string>{""});
  }
}

}  // namespace
}  // namespace plastron::domain
