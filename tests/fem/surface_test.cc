// The mid-surface over a mesh: charts in the coordinates of the cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/fem/surface.hpp>
#include <plastron/mesh/basis.hpp>

#include "fem/mesh_measure.hpp"
#include "geometry/finite_differences.hpp"
#include "geometry/surfaces.hpp"

namespace plastron::fem {
namespace {

using geometry::Chart;
using testing::HasSubstr;

std::shared_ptr<const mesh::CoarseMesh> shared(const domain::Domain& domain) {
  return std::make_shared<const mesh::CoarseMesh>(domain::coarse_mesh(domain, mesh::Shape::quadrilateral));
}

/// Some cells of a mesh: whole coarse cells and a dyadic part of each.
std::vector<Cell> some_cells(const mesh::CoarseMesh& mesh) {
  std::vector<Cell> cells;
  for (int c = 0; c < static_cast<int>(mesh.cells.size()); ++c) {
    cells.push_back({.coarse = c});
    cells.push_back({.coarse = c, .corner = {0.5, 0.25}, .size = 0.25});
  }
  return cells;
}

const std::vector<Vector2d> xi{{0.2, 0.3}, {0.5, 0.5}, {0.9, 0.7}};

TEST(Surface, HasFramesInTheCellsOwnCoordinates) {
  const auto mesh = shared(domain::Disk{.radius = 0.5});
  const Surface surface(mesh, {{"", geometry::surfaces().back().chart}});
  for (const Cell& cell : some_cells(*mesh)) {
    std::vector<geometry::Frame> frames(xi.size());
    surface.frames(cell, xi, frames);
    for (std::size_t p = 0; p < xi.size(); ++p) {
      const auto value = [&](double s, double t) -> geometry::Vector3d { return surface.frame(cell, {s, t}).phi; };
      const geometry::Frame other = geometry::frame_at(geometry::jet_by_differences<geometry::Vector3d>(value, xi[p]));
      EXPECT_LT((frames[p].phi - other.phi).norm(), 1e-8);
      for (std::size_t a = 0; a < 2; ++a) {
        EXPECT_LT((frames[p].a_cov[a] - other.a_cov[a]).norm(), 1e-8);
        EXPECT_LT((frames[p].da3[a] - other.da3[a]).norm(), 1e-7);
      }
    }
  }
}

TEST(Surface, has_jets_in_the_parameters_that_are_the_charts_own) {
  const auto mesh = shared(domain::Annulus{.inner = 0.2, .outer = 0.6});
  const Chart chart = geometry::surfaces().back().chart;
  const Surface surface(mesh, {{"", chart}});
  for (const Cell& cell : some_cells(*mesh)) {
    std::vector<geometry::SurfaceJet> jets(xi.size());
    std::vector<double> x(xi.size()), y(xi.size());
    surface.parameter_jets(cell, xi, jets);
    surface.positions(cell, xi, x, y);
    for (std::size_t p = 0; p < xi.size(); ++p) EXPECT_EQ(geometry::distance(jets[p], chart(x[p], y[p])), 0);
  }
}

TEST(Surface, uses_the_chart_of_each_region) {
  const auto mesh = shared(domain::Rectangle{.to = {2, 1}, .cells = {2, 1}, .breaks = {1}, .regions = {"low", "high"}});
  const Surface surface(mesh, {{"low", Chart({"x", "y", "0"}, {})}, {"high", Chart({"x", "y", "1"}, {})}});
  for (const Cell& cell : some_cells(*mesh)) {
    std::vector<geometry::Frame> frames(xi.size());
    surface.frames(cell, xi, frames);
    for (const auto& frame : frames) EXPECT_EQ(frame.phi[2], frame.phi[0] < 1 ? 0 : 1);
  }
}

std::string refusal(const std::map<std::string, Chart>& charts) {
  try {
    const Surface surface(shared(domain::Rectangle{.to = {2, 1}, .breaks = {1}, .regions = {"low", "high"}}), charts);
  } catch (const mesh::DomainError& error) {
    return error.what();
  }
  return "";
}

TEST(Surface, takes_one_unnamed_chart_for_all_regions) {
  EXPECT_EQ(refusal({{"", geometry::surfaces()[0].chart}}), "");
}

TEST(Surface, wants_a_chart_for_every_region_and_a_region_for_every_chart) {
  const Chart flat = geometry::surfaces()[0].chart;
  EXPECT_THAT(refusal({{"low", flat}}), HasSubstr("the region \"high\" has no chart"));
  const std::string unknown = refusal({{"low", flat}, {"high", flat}, {"middle", flat}});
  EXPECT_THAT(unknown, HasSubstr("\"middle\""));
  EXPECT_THAT(unknown, HasSubstr("low, high"));
}

TEST(Sides, list_the_nodes_that_lie_on_them_in_their_direction) {
  for (const int k : {1, 2, 5}) {
    const auto line = mesh::gauss_lobatto(k + 1).points;
    for (int side = 0; side < 4; ++side) {
      const auto nodes = mesh::side_nodes(mesh::Shape::quadrilateral, k, side);
      for (int i = 0; i <= k; ++i) {
        const int node = nodes[static_cast<std::size_t>(i)];
        const Vector2d at(line[static_cast<std::size_t>(node % (k + 1))],
                          line[static_cast<std::size_t>(node / (k + 1))]);
        EXPECT_EQ(at, mesh::side_point(mesh::Shape::quadrilateral, side, line[static_cast<std::size_t>(i)]));
      }
    }
  }
}

TEST(Sides, of_a_triangle_run_round_it) {
  for (const int k : {1, 2, 3}) {
    const auto points = mesh::lattice(mesh::Shape::triangle, k);
    for (int side = 0; side < 3; ++side) {
      const auto nodes = mesh::side_nodes(mesh::Shape::triangle, k, side);
      ASSERT_EQ(nodes.size(), static_cast<std::size_t>(k + 1));
      for (int i = 0; i <= k; ++i)
        EXPECT_LT((points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])] -
                   mesh::side_point(mesh::Shape::triangle, side, static_cast<double>(i) / k))
                      .norm(),
                  1e-15);
      EXPECT_EQ(mesh::side_point(mesh::Shape::triangle, side, 1),
                mesh::side_point(mesh::Shape::triangle, (side + 1) % 3, 0));
    }
  }
}

TEST(Sides, have_tangents_that_run_anticlockwise_and_are_the_derivatives_of_their_points) {
  for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle})
    for (int side = 0; side < mesh::corner_count(shape); ++side) {
      const Vector2d along = mesh::side_tangent(shape, side),
                     chord = mesh::side_point(shape, side, 1) - mesh::side_point(shape, side, 0),
                     inwards = mesh::centre(shape) - mesh::side_point(shape, side, 0.5);
      EXPECT_LT(std::min((along - chord).norm(), (along + chord).norm()), 1e-15);
      EXPECT_GT(along[0] * inwards[1] - along[1] * inwards[0], 0);
    }
}

}  // namespace
}  // namespace plastron::fem
