// Joined edges: two pieces with their own charts equal the one shell that they form, and a rectangle closes to a tube.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>

#include <numbers>

#include "computation/problems.hpp"

namespace plastron::computation {
namespace {

using namespace test;
using element::Formulation;

/// x = 0 to 2, pressed on a table: curved, clamped at one end, under a varying load.
problem::Problem of_chart(const std::string& x) {
  problem::Problem p;
  p.shell.sections.common.thickness = Expression("0.1", {});
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 5.0 / 6);
  p.charts = {{"", Chart({x, "y", "0.051 + 0.1*" + x + "^2"}, {})}};
  p.shell.loads.on_areas = {force(0, 0, -2e-3)};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  return p;
}

problem::Problem in_one_piece(mesh::Shape cells, int degree, Formulation formulation) {
  problem::Problem p = of_chart("x");
  p.domain = domain::Rectangle{.to = {2, 1}, .cells = {4, 2}};
  p.shell.supports = {clamped("left"), clamped("right")};
  p.discretisation = {.cells = cells, .degree = degree, .refinements = 1};
  p.shell.tangency = {.formulation = formulation};
  p.probes = {{.name = "seam", .at = {1, 0.5}}};
  return p;
}

problem::Problem in_two_pieces(mesh::Shape cells, int degree, Formulation formulation) {
  problem::Problem p = of_chart("x");
  p.domain = domain::MeshFile{.path = PLASTRON_TESTS_DIR "/computation/meshes/two-squares.msh"};
  p.charts = {{"first", p.charts.at("")}, {"second", of_chart("(x - 1)").charts.at("")}};
  p.joins = {{{"seam_a", "seam_b"}}};
  p.shell.supports = {clamped("west"), clamped("east")};
  p.discretisation = {.cells = cells, .degree = degree, .refinements = 1};
  p.shell.tangency = {.formulation = formulation};
  p.probes = {{.name = "seam", .at = {1, 0.5}}};
  return p;
}

struct Element {
  mesh::Shape cells;
  int degree;
  Formulation formulation;
};

class JoinedEdges : public testing::TestWithParam<Element> {};

TEST_P(JoinedEdges, OfTwoRectanglesGiveTheNumbersOfOne) {
  const auto [cells, degree, formulation] = GetParam();
  const problem::Problem problem = in_two_pieces(cells, degree, formulation);
  for (const auto& finding : examination::examine(problem))
    EXPECT_EQ(finding.text.find("not joined"), std::string::npos) << finding.text;
  const Result one = solve(in_one_piece(cells, degree, formulation), MPI_COMM_WORLD),
               two = solve(problem, MPI_COMM_WORLD);
  ASSERT_EQ(two.status, contact::Status::solved) << two.missed_limits;
  constexpr double same = 1e-9;
  EXPECT_NEAR(two.summary.energy.total(), one.summary.energy.total(), same * one.summary.energy.total());
  EXPECT_NEAR(two.summary.reaction.force[2], one.summary.reaction.force[2], same * one.summary.reaction.force[2]);
  EXPECT_NEAR(two.summary.contact_area, one.summary.contact_area, 1e-12);
  EXPECT_NEAR(two.summary.max_pressure, one.summary.max_pressure, 1e-8 * one.summary.max_pressure);
  EXPECT_EQ(two.summary.touching_nodes, one.summary.touching_nodes);
  EXPECT_EQ(two.summary.edge.nodes, one.summary.edge.nodes);
  EXPECT_NEAR(two.certificate.min_gap_between, one.certificate.min_gap_between, 1e-12);
  EXPECT_GT(one.summary.touching_nodes, 2);
  const auto &a = one.probes.at(0).values, &b = two.probes.at(0).values;
  EXPECT_LT((a.u - b.u).norm(), same * a.u.norm());
  EXPECT_NEAR(a.pressure, b.pressure, 1e-8 * one.summary.max_pressure);
  EXPECT_LT(two.certificate.stationarity, 1e-10);
  EXPECT_LT(two.certificate.energy_identity, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Each, JoinedEdges,
                         testing::Values(Element{mesh::Shape::quadrilateral, 2, Formulation::tangent},
                                         Element{mesh::Shape::quadrilateral, 3, Formulation::penalised},
                                         Element{mesh::Shape::quadrilateral, 2, Formulation::mixed},
                                         Element{mesh::Shape::quadrilateral, 2, Formulation::classical},
                                         Element{mesh::Shape::triangle, 1, Formulation::tangent},
                                         Element{mesh::Shape::triangle, 2, Formulation::tangent}));

struct Sizes {
  double least, most;
};
/// The least and the largest size of all cells, or of the cells with a side on a boundary (collective).
Sizes sizes_of_cells(const fem::Space& space, const std::string& boundary = "") {
  double least = 1, most = 0;
  const auto add = [&](std::size_t cell) {
    if (cell >= space.owned_cells) return;
    least = std::min(least, std::abs(space.cells[cell].size));
    most = std::max(most, std::abs(space.cells[cell].size));
  };
  for (const fem::BoundarySide& side : space.sides)
    if (side.boundary >= 0 && space.coarse->boundaries[static_cast<std::size_t>(side.boundary)] == boundary)
      add(side.cell);
  for (std::size_t cell = 0; boundary.empty() && cell < space.owned_cells; ++cell) add(cell);
  return {algebra::min_over_ranks(least, MPI_COMM_WORLD), algebra::max_over_ranks(most, MPI_COMM_WORLD)};
}

TEST(JoinedEdges, AreDividedAlikeOnMeshesThatAreGraded) {
  problem::Problem one = in_one_piece(mesh::Shape::quadrilateral, 3, Formulation::tangent),
                   two = in_two_pieces(mesh::Shape::quadrilateral, 3, Formulation::tangent);
  for (problem::Problem* p : {&one, &two}) {
    p->shell.obstacles.all.clear();
    p->discretisation.refinements = 0;
    p->accuracy = problem::Accuracy{.goals = {{"energy", 1e-4}}};
  }
  const Result in_one = solve(one, MPI_COMM_WORLD), in_two = solve(two, MPI_COMM_WORLD);
  ASSERT_EQ(in_two.status, contact::Status::solved) << in_two.missed_limits;
  EXPECT_NEAR(in_two.summary.energy.total(), in_one.summary.energy.total(), 1e-4 * in_one.summary.energy.total());
  const fem::Space& space = in_two.solution->discrete->space();
  const Sizes all = sizes_of_cells(space), first = sizes_of_cells(space, "seam_a"),
              second = sizes_of_cells(space, "seam_b");
  EXPECT_GT(all.most, 1.5 * all.least);
  EXPECT_EQ(first.least, first.most);
  EXPECT_EQ(second.least, first.most);
  EXPECT_EQ(second.most, first.most);
}

/// A tube of radius 1 around the y axis under inner pressure. Its ends slide radially.
problem::Problem tube() {
  problem::Problem p;
  p.domain = domain::Rectangle{.to = {2 * std::numbers::pi, 1}, .cells = {8, 2}};
  p.charts = {{"", Chart({"sin(x)", "y", "cos(x)"}, {})}};
  p.shell.sections.common.thickness = Expression("0.01", {});
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0, 1);
  p.joins = {{{"left", "right"}}};
  p.shell.supports = {{.boundary = "bottom", .components = {fixed(Unknown::displacement, Direction::y)}}};
  p.shell.loads.on_areas = {energy::AreaLoad{.pressure = Expression(1e-4)}};
  p.discretisation = {.degree = 4, .refinements = 1};
  return p;
}

TEST(JoinedEdges, MakeATubeWhoseOnlyFreeMotionsAreThoseOfATube) {
  std::vector<std::string> errors;
  for (const auto& finding : examination::examine(tube())) {
    EXPECT_EQ(finding.text.find("are not joined"), std::string::npos) << finding.text;
    if (finding.severity == examination::Severity::error) errors.push_back(finding.text);
  }
  EXPECT_EQ(errors.size(), 3U);  // slide in two directions, spin round the axis
}

TEST(JoinedEdges, MakeATubeThatCarriesPressureAsAMembrane) {
  problem::Problem p = tube();
  // Nothing moves along the ends or out of them.
  p.shell.supports.push_back(
      {.boundary = "top",
       .components = {fixed(Unknown::displacement, Direction::tangent), fixed(Unknown::displacement, Direction::y)}});
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  // w = p R^2 / (E e), energy 1/2 p w 2 pi R L, both less a part of e^2 / (12 R^2) for the bending of a wider circle.
  constexpr double pressure = 1e-4, w = pressure / 0.01;
  EXPECT_NEAR(result.summary.energy.total(), pressure * w * std::numbers::pi, 1e-4 * pressure * w);
  EXPECT_NEAR(result.summary.max_displacement, w, 1e-5 * w);
}

TEST(JoinedEdges, ThatDoNotMeetAreRefused) {
  problem::Problem p = tube();
  p.charts = {{"", Chart({"sin(0.9*x)", "y", "cos(0.9*x)"}, {})}};
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), mesh::DomainError);
  p = tube();
  p.joins = {{{"left", "middle"}}};
  EXPECT_THROW(solve(p, MPI_COMM_WORLD), mesh::DomainError);
}

}  // namespace
}  // namespace plastron::computation
