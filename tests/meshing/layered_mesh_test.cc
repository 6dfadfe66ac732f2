// Rows of thin cells along boundaries: they are as wide as asked for, and the mesh still is one of the whole domain.
#include <plastron/domain/domain.hpp>
#include <plastron/meshing/layered_mesh.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "fem/mesh_measure.hpp"

namespace plastron::fem::layered_mesh_test {
namespace {

using std::numbers::pi;
using Distances = std::vector<std::vector<std::vector<double>>>;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The edges of each boundary: how many, and their length.
std::map<std::string, std::pair<int, double>> edges_by_name(const mesh::CoarseMesh& mesh) {
  std::map<std::string, std::pair<int, double>> result;
  for (const mesh::BoundaryEdge& e : mesh.edges) {
    const auto at = [&](int k) {
      return mesh.vertices[static_cast<std::size_t>(e.vertices[static_cast<std::size_t>(k)])];
    };
    auto& [count, length] = result[mesh.boundaries[static_cast<std::size_t>(e.boundary)]];
    ++count;
    length += (at(1) - at(0)).norm();
  }
  return result;
}

TEST(LayeredRectangle, HasLinesAtTheDistancesOfItsRowsFromEverySide) {
  const domain::Rectangle r{.from = {-1, 2}, .to = {2, 4}};
  const meshing::Rows rows{.distances = Distances{{{0.1, 0.3}}, {{0.2}}, {{0.05}}, {{}}}, .inner = {3, 2}};
  const mesh::CoarseMesh mesh = meshing::layered_mesh(r, mesh::Shape::quadrilateral, rows);
  expect_cells_fit(mesh);
  EXPECT_NEAR(area(mesh), 6, 1e-13);
  EXPECT_EQ(mesh.cells.size(), static_cast<std::size_t>((2 + 3 + 1) * (1 + 2)));
  std::set<double> xs, ys;
  for (const Vector2d& v : mesh.vertices) {
    xs.insert(std::round(v[0] * 1e9) / 1e9);
    ys.insert(std::round(v[1] * 1e9) / 1e9);
  }
  for (const double x : {-0.9, -0.7, 1.8}) EXPECT_TRUE(xs.contains(x)) << x;
  EXPECT_TRUE(ys.contains(2.05));
  auto edges = edges_by_name(mesh);
  EXPECT_EQ(edges["left"].first, 3);
  EXPECT_EQ(edges["top"].first, 6);
  EXPECT_NEAR(edges["left"].second, 2, 1e-13);
  EXPECT_NEAR(edges["top"].second, 3, 1e-13);
}

TEST(LayeredRectangle, HasRowsOfTheirOwnWidthInEveryRegion) {
  const domain::Rectangle r{.to = {3, 1}, .breaks = {1}, .regions = {"thin", "thick"}};
  const meshing::Rows rows{.distances = Distances{{{0.1}}, {{0.2}}, {{0.1}, {0.2}}, {{0.1}, {0.2}}}, .inner = {6, 1}};
  const mesh::CoarseMesh mesh = meshing::layered_mesh(r, mesh::Shape::quadrilateral, rows);
  expect_cells_fit(mesh);
  EXPECT_NEAR(area(mesh), 3, 1e-13);
  bool has_thin = false, has_thick = false;
  for (const Vector2d& v : mesh.vertices) {
    has_thin = has_thin || (v - Vector2d(0, 0.1)).norm() < 1e-12;
    has_thick = has_thick || (v - Vector2d(3, 0.2)).norm() < 1e-12;
  }
  EXPECT_TRUE(has_thin && has_thick);
  for (const mesh::CoarseCell& cell : mesh.cells) {
    const Vector2d middle = cell.map({0.5, 0.5}).value;
    EXPECT_EQ(mesh.regions[static_cast<std::size_t>(cell.region)], middle[0] < 1 ? "thin" : "thick");
  }
}

TEST(LayeredRectangle, RefusesRowsThatMeet) {
  const meshing::Rows rows{.distances = Distances{{{0.6}}, {{0.5}}, {{}}, {{}}}};
  EXPECT_THROW(meshing::layered_mesh(domain::Rectangle{}, mesh::Shape::quadrilateral, rows), mesh::DomainError);
}

TEST(LayeredDisk, HasRingsAlongTheRim) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const domain::Disk disk{.centre = {3 * scale, 0}, .radius = 2 * scale};
    const meshing::Rows rows{.distances = Distances{{{0.1 * scale, 0.4 * scale}}}, .inner = {2, 3}};
    const mesh::CoarseMesh mesh = meshing::layered_mesh(disk, mesh::Shape::quadrilateral, rows);
    expect_cells_fit(mesh);
    EXPECT_NEAR(area(mesh) / (scale * scale), 4 * pi, 1e-6);
    EXPECT_EQ(mesh.cells.size(), 4u + 4 * 2 * 3 + 2 * 8);
    EXPECT_EQ(mesh.edges.size(), 8u);
    for (const double radius : {1.6, 1.9, 2.0})
      EXPECT_EQ(std::ranges::count_if(
                    mesh.vertices,
                    [&](const Vector2d& v) { return std::abs((v - disk.centre).norm() / scale - radius) < 1e-9; }),
                8)
          << radius;
  }
}

TEST(LayeredAnnulus, HasRingsAlongBothRims) {
  const domain::Annulus annulus{.centre = {1, 1}, .inner = 0.5, .outer = 2};
  const meshing::Rows rows{.distances = Distances{{{0.1}}, {{0.2, 0.3}}}, .inner = {6, 2}};
  const mesh::CoarseMesh mesh = meshing::layered_mesh(annulus, mesh::Shape::quadrilateral, rows);
  expect_cells_fit(mesh);
  EXPECT_NEAR(area(mesh), pi * 3.75, 1e-6);
  EXPECT_EQ(mesh.cells.size(), 6u * (1 + 2 + 2));
  auto edges = edges_by_name(mesh);
  EXPECT_EQ(edges["inner"].first, 6);
  EXPECT_EQ(edges["outer"].first, 6);
}

struct NamedPolygon {
  std::vector<Vector2d> corners;
  double depth;
};

std::vector<NamedPolygon> polygons() {
  return {{{{2, 0}, {0, 2}, {-2, 0}, {0, -2}}, 0.1},
          {{{0, 0}, {3, 0.2}, {2.5, 2}, {0.3, 1.5}}, 0.1},
          {{{0, 0}, {4, 0}, {2, 3}}, 0.15},
          {{{2, 0}, {1, 1.7}, {-1, 1.7}, {-2, 0}, {-1, -1.7}, {1, -1.7}}, 0.2},
          {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.1},
          {{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, 0.08}};
}

TEST(LayeredPolygon, CoversItWithRowsOfTheirDepthAlongEverySide) {
  for (auto [corners, depth] : polygons())
    for (const bool reversed : {false, true})
      for (const double scale : {1.0, 1e-6, 1e6}) {
        std::vector<Vector2d> scaled;
        for (const Vector2d& c : corners) scaled.emplace_back(scale * c);
        if (reversed) std::ranges::reverse(scaled);
        const domain::Polygon polygon{scaled};
        const std::size_t n = scaled.size();
        const meshing::Rows rows{.distances = Distances(n, {{depth * scale}}), .inner = {6, 6}};
        const mesh::CoarseMesh mesh = meshing::layered_mesh(polygon, mesh::Shape::quadrilateral, rows);
        expect_cells_fit(mesh);
        EXPECT_NEAR(area(mesh) / std::abs(domain::signed_area(polygon)), 1, 1e-9);
        auto edges = edges_by_name(mesh);
        for (std::size_t i = 0; i < n; ++i) {
          const Vector2d from = scaled[i], to = scaled[(i + 1) % n];
          EXPECT_NEAR(edges["edge" + std::to_string(i + 1)].second / (to - from).norm(), 1, 1e-9);
          const Vector2d along = (to - from).normalized();
          const auto is_on_line = [&, off = depth * scale](const Vector2d& v) {
            return std::abs(std::abs(cross(along, v - from)) - off) < 1e-9 * scale;
          };
          EXPECT_GE(std::ranges::count_if(mesh.vertices, is_on_line), 2) << n << " corners, side " << i;
        }
      }
}

TEST(LayeredPolygon, RefusesRowsThatMeet) {
  const domain::Polygon bar{{{0, 0}, {1, 0}, {2, 0}, {2, 0.1}, {0, 0.1}}};
  EXPECT_THROW(
      meshing::layered_mesh(bar, mesh::Shape::quadrilateral, meshing::Rows{.distances = Distances(5, {{0.06}})}),
      mesh::DomainError);
}

TEST(LayeredMesh, OfTrianglesIsItsQuadrilateralsCutCrosswise) {
  const meshing::Rows rows{.distances = Distances{{{0.1}}, {{0.1}}, {{}}, {{}}}, .inner = {2, 2}};
  const mesh::CoarseMesh mesh = meshing::layered_mesh(domain::Rectangle{}, mesh::Shape::triangle, rows);
  expect_cells_fit(mesh);
  EXPECT_EQ(mesh.cells.size(), 4u * 8);
  EXPECT_NEAR(area(mesh), 1, 1e-13);
}

}  // namespace
}  // namespace plastron::fem::layered_mesh_test
