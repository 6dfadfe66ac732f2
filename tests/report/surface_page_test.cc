// The page of a mesh in space: its scene is the mesh, its tables are the parts, names remain texts.
#include "domain/space_surface.hpp"

#include <plastron/report/embedded_page.hpp>
#include <plastron/report/surface_page.hpp>
#include <plastron/report/surface_scene.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <report/decoded_base64.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::report::surface_page_tests {

namespace {

using namespace topology::space_meshes;  // NOLINT: builders of meshes
using namespace domain::space_meshes;    // NOLINT: builders of meshes
using Eigen::Vector3d;
using mesh::Shape;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Json scene_of(const domain::FileSurface& surface, std::size_t most_points = most_parts_points) {
  return surface_scene_json(surface, region_parts(surface), curve_parts(surface), most_points);
}

std::string page_of(const domain::FileSurface& surface, const std::vector<PageFinding>& findings = {}) {
  const auto regions = region_parts(surface);
  const auto curves = curve_parts(surface);
  return surface_page_html({"folder/part.msh", surface, regions, curves, findings});
}

template <class Number>
std::vector<Number> numbers(const Json& text) {
  return decoded_numbers<Number>(text.get<std::string>());
}

Vector3d vector_at(const std::vector<float>& numbers, std::size_t point) {
  return {numbers[3 * point], numbers[3 * point + 1], numbers[3 * point + 2]};
}

TEST(SurfaceScene, has_curved_cells_and_their_normals) {
  for (const Shape shape : shapes) {
    const Json scene = scene_of(surface_of(sphere(shape, 3, 4)));
    const auto points = numbers<float>(scene["positions"]), normals = numbers<float>(scene["normals"]);
    const auto per_cell = static_cast<std::size_t>(mesh::nodes_per_cell(shape, scene["subdivisions"]));
    EXPECT_GE(scene["subdivisions"], 4);
    ASSERT_EQ(points.size(), 3 * per_cell * scene["cells"].get<std::size_t>());
    ASSERT_EQ(normals.size(), points.size());
    const Vector3d origin(scene["origin"][0], scene["origin"][1], scene["origin"][2]);
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
      const Vector3d place = origin + vector_at(points, i);
      EXPECT_NEAR(place.norm(), 1, 1e-3);                      // between the nodes, too
      EXPECT_NEAR(place.dot(vector_at(normals, i)), 1, 1e-2);  // outwards
    }
  }
}

TEST(SurfaceScene, is_exact_far_from_the_origin) {
  topology::SpaceMesh mesh = sphere(Shape::quadrilateral, 2, 2), far = mesh;
  for (Vector3d& node : far.nodes) node += Vector3d(1e6, 0, -3e6);
  const auto near_points = numbers<float>(scene_of(surface_of(std::move(mesh)))["positions"]);
  const auto far_points = numbers<float>(scene_of(surface_of(std::move(far)))["positions"]);
  ASSERT_EQ(near_points.size(), far_points.size());
  for (std::size_t i = 0; i < near_points.size(); ++i) EXPECT_NEAR(near_points[i], far_points[i], 1e-6);
}

TEST(SurfaceScene, has_kinds_and_names_of_edges) {
  // Three plates on the y axis, the end of the first one named: a branch of 2 edges, borders of 3 x 6 edges.
  const auto is_end = [](const Vector3d& x) { return x[0] > 1 - 1e-9; };
  const Json scene = scene_of(surface_of(star(Shape::quadrilateral, 2, 1, {0, 2, 4}), {{"end", is_end}}));
  const auto kind = numbers<std::uint32_t>(scene["edges"]["kind"]);
  const auto count = [&](const char* name) {
    const auto& kinds = scene["edges"]["kinds"];
    const auto k = std::ranges::find(kinds, Json(name)) - kinds.begin();
    return std::ranges::count(kind, static_cast<std::uint32_t>(k));
  };
  EXPECT_EQ(count("branch"), 2);
  EXPECT_EQ(count("border"), 18);
  EXPECT_EQ(kind.size(), 20U);
  std::vector<std::string> names;
  for (const Json& curve : scene["curves"]) names.push_back(curve["name"]);
  EXPECT_THAT(names, ElementsAre("end", "fold 1", "(borders without name)"));
  // The end's edges lie at x = 1, and so does its name.
  const auto points = numbers<float>(scene["positions"]);
  const auto places = numbers<std::uint32_t>(scene["edges"]["places"]);
  const auto on_end = numbers<std::uint32_t>(scene["curves"][0]["edges"]);
  const auto marks = numbers<std::uint32_t>(scene["curves"][0]["marks"]);
  const auto x = [&](std::uint32_t point) { return scene["origin"][0].get<double>() + points[3 * point]; };
  ASSERT_EQ(on_end.size(), 2U);
  for (const std::uint32_t edge : on_end)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(x(places[2 * edge + k]), 1, 1e-6);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_NEAR(x(marks[0]), 1, 1e-6);
  EXPECT_EQ(numbers<std::uint32_t>(scene["curves"][2]["marks"]).size(), 0U);  // no name of a case
  // Each side of a cell on a branch leads to it.
  const auto sides = numbers<std::uint32_t>(scene["edges"]["sides"]);
  EXPECT_EQ(std::ranges::count_if(sides, [](std::uint32_t edge) { return edge > 0; }), 18 + 2 * 3);
}

TEST(SurfaceScene, marks_turned_cells_and_doubtful_edges) {
  topology::SpaceMesh mesh = star(Shape::quadrilateral, 3, 1, {0, pi - 0.5});  // 29 degrees; the limit is 30
  mesh.cells[4] = topology::turned(mesh.shape, mesh.cells[4]);
  for (std::size_t c = 9; c < 18; ++c) mesh.cells[c] = topology::turned(mesh.shape, mesh.cells[c]);
  const domain::FileSurface surface = surface_of(std::move(mesh));
  const Json scene = scene_of(surface);
  const auto turned = numbers<std::uint32_t>(scene["turned"]),
             doubtful = numbers<std::uint32_t>(scene["edges"]["doubtful"]);
  EXPECT_EQ(std::ranges::count(turned, 1U), 1);
  EXPECT_EQ(turned[4], 1U);
  EXPECT_EQ(std::ranges::count(doubtful, 1U), 3);
  EXPECT_THAT(page_of(surface), HasSubstr("<section id=\"doubtful\""));
  EXPECT_THAT(page_of(surface_of(cube(Shape::quadrilateral, 2))), Not(HasSubstr("<section id=\"doubtful\"")));
}

TEST(SurfaceScene, has_fewer_facets_on_large_meshes_and_none_on_huge_ones) {
  const topology::SpaceMesh mesh = sphere(Shape::quadrilateral, 4, 3);  // 96 cells
  EXPECT_EQ(parts_subdivisions(mesh), 4);
  EXPECT_EQ(parts_subdivisions(mesh, 96 * 16), 3);
  EXPECT_EQ(parts_subdivisions(mesh, 96 * 9, 10), 1);
  EXPECT_EQ(parts_subdivisions(mesh, 96 * 4 - 1), 0);
  EXPECT_EQ(parts_subdivisions(sphere(Shape::triangle, 4, 1)), 1);
  const domain::FileSurface surface = surface_of(sphere(Shape::quadrilateral, 4, 3));
  EXPECT_TRUE(scene_of(surface, 96).is_null());
}

TEST(SurfaceParts, are_the_areas_and_lengths_of_a_cube) {
  const domain::FileSurface surface = surface_of(cube(Shape::quadrilateral, 3));
  const auto regions = region_parts(surface);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_NEAR(regions[0].area, 6, 1e-12);
  EXPECT_FALSE(regions[0].normal);
  EXPECT_LT(regions[0].middle.norm(), 1e-12);
  const auto curves = curve_parts(surface);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].name, "fold 1");
  EXPECT_NEAR(curves[0].length, 12, 1e-12);
  EXPECT_NEAR(curves[0].largest_angle, pi / 2, 1e-12);
  EXPECT_EQ(kinds_text(curves[0]), "36 fold");
}

TEST(SurfacePage, has_the_tables_and_the_findings) {
  const std::string page =
      page_of(surface_of(cube(Shape::quadrilateral, 3)), {{true, "look here"}, {false, "all is < well"}});
  EXPECT_THAT(page, AllOf(HasSubstr("<title>Parts of part.msh</title>"), HasSubstr("<main class=\"parts\">"),
                          HasSubstr("<li>look here</li>"), HasSubstr("<li>all is &lt; well</li>"),
                          HasSubstr("<td class=\"word\">fold 1</td>"), HasSubstr("36 fold"), Not(HasSubstr("{{"))));
  EXPECT_EQ(embedded_page().script.empty(), page.find("<div id=\"view\">") == std::string::npos);
}

TEST(SurfacePage, of_names_that_look_like_markup_shows_them_as_text) {
  const std::string evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\" {{script}} <!-- \xff";
  const auto is_end = [](const Vector3d& x) { return x[0] > 1 - 1e-9; };
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  };
  domain::FileSurface surface = surface_of(star(Shape::quadrilateral, 2, 1, {0, 2}), {{"end", is_end}});
  const std::string plain = page_of(surface);
  surface.regions.front() = evil;
  surface.boundaries.front() = evil;
  const std::string page = page_of(surface, {{true, evil}, {false, evil}});
  for (const char* part : {"<script", "</script", "<!--", "<img src=x"})
    EXPECT_EQ(count(page, part), count(plain, part)) << part;
  EXPECT_THAT(page, AllOf(HasSubstr("&lt;/script&gt;&lt;script&gt;alert(1)"), Not(HasSubstr("\xff"))));
}

TEST(SurfacePage, has_a_name_that_replaces_no_mesh) {
  EXPECT_EQ(page_name_mistake("out/parts.html", "part.msh"), "");
  EXPECT_THAT(page_name_mistake("part.msh", "part.msh"), HasSubstr("must end in .html"));
  EXPECT_THAT(page_name_mistake("parts", "part.msh"), HasSubstr("must end in .html"));
}

}  // namespace

}  // namespace plastron::report::surface_page_tests
