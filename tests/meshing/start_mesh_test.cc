// Start meshes: widths of layers follow the shell's thickness and curvature, and the mesh does not depend on units.
#include <plastron/meshing/sequence.hpp>
#include <plastron/meshing/start_mesh.hpp>

#include <gtest/gtest.h>

#include <cmath>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using test::clamped;
using test::symmetry;
using test::with_chart;

problem::Problem layered(const domain::Domain& domain, const std::array<std::string, 3>& chart, double thickness,
                         double unit = 1) {
  problem::Problem p = with_chart(test::free_plate(), chart, {{"L", unit}});
  p.domain = domain;
  p.shell.sections.common.thickness = geometry::Expression(thickness);
  p.discretisation = {.degree = 4, .layers = problem::Layers::automatic, .refinements = 0};
  return p;
}

problem::Problem saddle(double e, double unit = 1) {
  const domain::Rectangle square{.from = {-0.5 * unit, -0.5 * unit}, .to = {0.5 * unit, 0.5 * unit}};
  return layered(square, {"x", "y", "(x^2 - y^2)/L"}, e * unit, unit);
}

TEST(LayerWidth, IsTheRootThirdRootOrFourthRootOfTheThickness) {
  const double e = 1e-4, R = 2, L = 3;
  EXPECT_NEAR(meshing::layer_width(e, {.along = 1 / R}, L), std::sqrt(e * R), 1e-9);
  EXPECT_NEAR(meshing::layer_width(e, {.twist = 1 / R}, L), std::cbrt(e * R * L / 2), 1e-9);
  EXPECT_NEAR(meshing::layer_width(e, {.across = 1 / R}, L), std::pow(e * R * L * L, 0.25), 1e-9);
  EXPECT_EQ(meshing::layer_width(e, {}, L), INFINITY);
}

TEST(EdgeLayers, OfACylinderAreThoseOfItsRingsAndOfItsGenerators) {
  const double e = 1e-4, R = 1, length = 2, angle = 0.8;
  const auto layers =
      meshing::edge_layers(layered(domain::Rectangle{.to = {angle, length}}, {"sin(x)", "y", "cos(x)"}, e));
  ASSERT_EQ(layers.size(), 4u);
  for (const meshing::EdgeLayer& layer : layers) {
    const bool is_ring = layer.boundary >= 2;
    const double expected = is_ring ? std::sqrt(e * R) : std::pow(e * length * length * R, 0.25);
    EXPECT_NEAR(layer.width, expected, 1e-6) << layer.boundary;
  }
}

TEST(EdgeLayers, AreMeasuredAcrossTheEdgeInOmega) {
  // x is stretched by 5, so a step in x is five times as long on the shell.
  const auto layers =
      meshing::edge_layers(layered(domain::Rectangle{.to = {0.2, 1}}, {"5*x", "sin(y)", "cos(y)"}, 1e-4));
  ASSERT_EQ(layers.size(), 4u);
  EXPECT_NEAR(layers[0].width, 0.01, 1e-8);
  EXPECT_NEAR(layers[0].width_in_omega, 0.002, 1e-9);
}

TEST(StartMesh, HasNarrowRowsWhereMoreIsAskedForThanCornersWithOneRowGive) {
  const auto has = [](double e, double tolerance, int degree = 4) {
    problem::Problem p = saddle(e);
    p.discretisation.degree = degree;
    p.accuracy = problem::Accuracy{.goals = {{"energy", tolerance}}};
    return meshing::start_mesh(p).has_narrow_rows;
  };
  EXPECT_FALSE(meshing::start_mesh(saddle(1e-3)).has_narrow_rows);
  EXPECT_TRUE(has(1e-2, 1e-3));
  EXPECT_FALSE(has(1e-3, 1e-3));
  EXPECT_TRUE(has(1e-3, 1e-4));
  EXPECT_FALSE(has(1e-4, 1e-4));  // its corners are a smaller part of it
  EXPECT_TRUE(has(1e-4, 1e-5));
  EXPECT_FALSE(has(1e-2, 1e-3, 6));
}

TEST(StartMesh, HasRowsAlongEveryEdgeOfAThinShellAndNoneOfAPlate) {
  EXPECT_EQ(meshing::start_mesh(saddle(1e-3)).rows.size(), 4u);
  EXPECT_TRUE(meshing::start_mesh(layered(domain::Rectangle{}, {"x", "y", "0"}, 1e-3)).rows.empty());
  EXPECT_TRUE(meshing::start_mesh(saddle(0.1)).rows.empty()) << "rows would take more than a quarter of the shell";
}

TEST(StartMesh, HasNoRowsWhereTheShellGoesOn) {
  problem::Problem p = saddle(1e-3);
  p.shell.supports = {clamped("left"), symmetry("bottom")};
  const auto rows = meshing::start_mesh(p).rows;
  ASSERT_EQ(rows.size(), 3u);
  for (const meshing::EdgeLayer& row : rows) EXPECT_NE(row.boundary, 2);
}

TEST(StartMesh, OfRegionsHasRowsThatFollowTheirThickness) {
  problem::Problem p = layered(domain::Rectangle{.to = {2, 1}, .breaks = {1}, .regions = {"thin", "thick"}},
                               {"x", "sin(y)", "cos(y)"}, 1e-4);
  const auto chart = p.charts.begin()->second;
  p.charts.clear();
  for (const char* name : {"thin", "thick"}) p.charts.emplace(name, chart);
  p.shell.sections.regions["thick"] = p.shell.sections.common;
  p.shell.sections.regions["thick"].thickness = geometry::Expression(4e-4);
  const auto layers = meshing::edge_layers(p);
  ASSERT_EQ(layers.size(), 6u);
  EXPECT_NEAR(layers[1].width / layers[0].width, 2, 1e-6);
  EXPECT_EQ(meshing::start_mesh(p).coarse.regions.size(), 2u);
}

TEST(StartMesh, IsTheSameInAllUnits) {
  for (const double e : {1e-2, 1e-3, 1e-4}) {
    const meshing::StartMesh mesh = meshing::start_mesh(saddle(e));
    for (const double unit : {1e-6, 1e6}) {
      const meshing::StartMesh other = meshing::start_mesh(saddle(e, unit));
      ASSERT_EQ(other.coarse.vertices.size(), mesh.coarse.vertices.size());
      for (std::size_t i = 0; i < mesh.coarse.vertices.size(); ++i)
        EXPECT_LT((other.coarse.vertices[i] / unit - mesh.coarse.vertices[i]).norm(), 1e-9);
    }
  }
}

TEST(StartMesh, IsFinerInsideForThinnerShellsAndCoarserWhereItWillBeRefined) {
  problem::Problem p = saddle(1e-4);
  const auto fine = meshing::start_mesh(p).coarse.cells.size();
  EXPECT_GT(fine, meshing::start_mesh(saddle(1e-3)).coarse.cells.size());
  p.discretisation.refinements = 2;
  EXPECT_LT(meshing::start_mesh(p).coarse.cells.size(), fine);
}

TEST(StartMesh, KeepsPointsThatAreHeldAmongItsNodes) {
  problem::Problem p = saddle(1e-3);
  p.shell.supports = {{.components = {test::fixed(assembly::Unknown::displacement, assembly::Direction::z)},
                       .point = Eigen::Vector2d(0.123, 0)}};
  EXPECT_FALSE(meshing::start_mesh(p).no_rows.empty());
}

TEST(StartMesh, CountsTheNodesThatTheSequenceHas) {
  for (const mesh::Shape shape : {mesh::Shape::quadrilateral, mesh::Shape::triangle}) {
    problem::Problem p = saddle(1e-2);
    p.discretisation.cells = shape;
    p.discretisation.degree = 2;
    auto meshes = meshing::mesh_sequence(p, MPI_COMM_SELF);
    const meshing::StartMesh mesh = meshing::start_mesh(p);
    EXPECT_EQ(meshing::node_count(mesh.coarse, 2, 0), meshes.space()->layout->global_size);
    meshes.refine({});
    EXPECT_EQ(meshing::node_count(mesh.coarse, 2, 1), meshes.space()->layout->global_size);
  }
}

TEST(StartMesh, IsDescribedWithItsRowsAndItsSize) {
  const problem::Problem p = saddle(1e-3);
  const std::string text = meshing::describe(meshing::start_mesh(p), p);
  EXPECT_NE(text.find("rows along left"), std::string::npos) << text;
  EXPECT_NE(text.find("unknowns of degree 4"), std::string::npos) << text;
  problem::Problem plain = p;
  plain.discretisation.layers = problem::Layers::none;
  EXPECT_EQ(meshing::describe(meshing::start_mesh(plain), plain), "");
}

TEST(StartMesh, ThatIsLargeIsToldWhereMeshesFollowFromAnAccuracy) {
  problem::Problem p = saddle(1e-2);
  p.domain = domain::Rectangle{.cells = {100, 90}};
  p.accuracy = problem::Accuracy{};
  const auto is_large = [&] {
    return meshing::describe(meshing::start_mesh(p), p).find("large first mesh") != std::string::npos;
  };
  EXPECT_TRUE(is_large());
  p.discretisation.degree = 2;
  EXPECT_FALSE(is_large());
  p.discretisation.degree = 4;
  p.domain = domain::Rectangle{.cells = {40, 40}};
  EXPECT_FALSE(is_large());
}

}  // namespace
}  // namespace plastron::computation
