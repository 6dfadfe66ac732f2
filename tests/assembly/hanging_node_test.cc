// A planted hanging node: one cell beside two half as large. Fields are continuous, strains of fields of the space are
// exact, and the form stays symmetric (docs/model.md, section 7).
#include <gtest/gtest.h>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/constraints/map.hpp>
#include <plastron/domain/domain_mesh.hpp>
#include <plastron/mesh/basis.hpp>

#include <cmath>
#include <map>

#include "assembly/sample_shells.hpp"

namespace plastron::assembly {
namespace {

using Eigen::Matrix;
using Eigen::Vector3d;

/// The rectangle [0, 2] x [0, 1]: the left cell is whole, the right one is cut in four.
test::MeshedSurface with_hanging_nodes(int degree, const std::array<std::string, 3>& chart) {
  auto coarse = std::make_shared<mesh::CoarseMesh>(
      domain::coarse_mesh(domain::Rectangle{.to = {2, 1}, .cells = {2, 1}}, mesh::Shape::quadrilateral));
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(chart, {}));
  auto surface = std::make_shared<const fem::Surface>(coarse, charts);
  auto space = std::make_shared<fem::Space>();
  space->degree = degree;
  space->coarse = coarse;
  space->cells = {{.coarse = 0}};
  for (const double y : {0.0, 0.5})
    for (const double x : {0.0, 0.5}) space->cells.push_back({.coarse = 1, .corner = {x, y}, .size = 0.5});
  space->owned_cells = space->cells.size();
  space->global_cells = static_cast<std::int64_t>(space->cells.size());

  const auto line = mesh::gauss_lobatto(degree + 1).points;
  std::vector<Eigen::Vector2d> xi;
  for (const double b : line)
    for (const double a : line) xi.emplace_back(a, b);
  std::map<std::pair<long, long>, algebra::LocalIndex> numbers;
  std::vector<Eigen::Vector2d> places;
  space->connectivity.nodes_per_element = static_cast<int>(xi.size());
  for (const fem::Cell& cell : space->cells) {
    std::vector<double> x(xi.size()), y(xi.size());
    surface->positions(cell, xi, x, y);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const auto [at, is_new] = numbers.emplace(std::pair(std::lround(1e9 * x[i]), std::lround(1e9 * y[i])),
                                                static_cast<int>(numbers.size()));
      if (is_new) places.emplace_back(x[i], y[i]);
      space->connectivity.nodes.push_back(at->second);
    }
  }
  const auto nodes = static_cast<algebra::LocalIndex>(places.size());
  space->layout = std::make_shared<const algebra::Layout>(algebra::Distribution{.owned = nodes, .global_size = nodes});

  // On x = 1 the nodes of the large cell's side are masters; all other nodes hang.
  const auto on_side = mesh::side_nodes(mesh::Shape::quadrilateral, degree, 1);
  std::vector<algebra::LocalIndex> masters;
  for (const int i : on_side) masters.push_back(space->connectivity.nodes[static_cast<std::size_t>(i)]);
  std::vector<constraints::Row> rows;
  for (std::size_t node = 0; node < places.size(); ++node) {
    if (std::abs(places[node][0] - 1) > 1e-9 || std::ranges::count(masters, static_cast<int>(node)) > 0) continue;
    constraints::Row& row = rows.emplace_back(constraints::Row{.node = static_cast<algebra::LocalIndex>(node)});
    for (std::size_t k = 0; k < masters.size(); ++k) {
      double weight = 1;
      for (std::size_t j = 0; j < masters.size(); ++j)
        if (j != k) weight *= (places[node][1] - line[j]) / (line[k] - line[j]);
      row.terms.push_back({.node = masters[k], .weight = weight});
    }
  }
  space->continuity = constraints::Map(std::move(rows), MPI_COMM_SELF);
  space->constraints = space->continuity;
  return {space, surface};
}

std::unique_ptr<DiscreteShell> shell_on(const test::MeshedSurface& m, element::Formulation formulation) {
  return discretise(m.space, m.surface,
                    {.sections = test::steel_of(geometry::Expression(0.1)),
                     .tangency = {.formulation = formulation},
                     .obstacles = {.all = {{.shape = obstacle::HalfSpace{.point = {0, 0, -1}}}}}});
}

class HangingNode : public testing::TestWithParam<int> {};

TEST_P(HangingNode, IsThere) {
  const auto m = with_hanging_nodes(GetParam(), test::flat);
  EXPECT_GE(m.space->continuity.rows().size(), static_cast<std::size_t>(GetParam()) - (GetParam() > 1 ? 1 : 0));
}

TEST_P(HangingNode, LetsRigidMotionsGiveNoEnergy) {
  for (const auto& chart : {test::flat, test::saddle}) {
    const auto m = with_hanging_nodes(GetParam(), chart);
    const auto shell = shell_on(m, element::Formulation::tangent);
    algebra::Vector y = test::rigid_motion(*m.space, shell->points, {0.1, -0.2, 0.3}, {0.2, 0.1, -0.3}), continuous = y;
    m.space->continuity.apply(continuous);
    for (std::size_t i = 0; i < y.local().size(); ++i) {
      // Translations and, on the flat shell, rotations lie in the space.
      if (chart == test::flat) {
        EXPECT_NEAR(continuous.local()[i], y.local()[i], 1e-13);
      }
    }
    if (chart == test::flat) {
      EXPECT_LT(shell->shell.energies(continuous).total(), 1e-24);
    }
  }
}

/// The patch test: every free node is in equilibrium with a linear displacement, or with a rotation that is the slope of a quadratic one.
TEST_P(HangingNode, PassesThePatchTest) {
  const auto m = with_hanging_nodes(GetParam(), test::flat);
  const auto shell = shell_on(m, element::Formulation::tangent);
  const bool bends = GetParam() >= 2;
  algebra::Vector y(m.space->layout, 6), f(y);
  for (std::size_t i = 0; i < shell->points.size(); ++i) {
    const double x1 = shell->points[i].x[0], x2 = shell->points[i].x[1];
    const double values[] = {0.3 * x1 - 0.1 * x2,
                             0.2 * x1 + 0.4 * x2,
                             bends ? 0.5 * x1 * x1 + 0.2 * x1 * x2 : 0.1 * x1,
                             bends ? -(x1 + 0.2 * x2) : -0.1,
                             bends ? -0.2 * x1 : 0.0,
                             0.0};
    std::copy_n(values, 6, y.local().begin() + static_cast<std::ptrdiff_t>(6 * i));
  }
  algebra::Vector same = y;
  m.space->continuity.apply(same);
  for (std::size_t i = 0; i < y.local().size(); ++i) EXPECT_NEAR(same.local()[i], y.local()[i], 1e-13);
  shell->apply(y, f);
  m.space->constraints.apply_transposed(f);
  int inside = 0;
  for (std::size_t i = 0; i < shell->points.size(); ++i) {
    const double x1 = shell->points[i].x[0], x2 = shell->points[i].x[1];
    if (x1 < 1e-9 || x1 > 2 - 1e-9 || x2 < 1e-9 || x2 > 1 - 1e-9) continue;
    ++inside;
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(f.local()[6 * i + k], 0, 1e-14) << x1 << " " << x2;
  }
  EXPECT_GT(inside, 0);
}

TEST_P(HangingNode, LeavesTheFormSymmetricAndTheMatrixTheOperator) {
  for (const auto formulation :
       {element::Formulation::tangent, element::Formulation::penalised, element::Formulation::classical}) {
    const auto m = with_hanging_nodes(GetParam(), test::saddle);
    const auto shell = shell_on(m, formulation);
    const algebra::Matrix A = stiffness_matrix(*shell);
    const contact::BoxProblem box = box_problem(*shell, A);
    algebra::Vector a(m.space->layout, shell->coordinates.width), b(a), Aa(a), Ab(a), Ma(a);
    algebra::fill_with_pseudo_random_values(a, 1);
    algebra::fill_with_pseudo_random_values(b, 2);
    box.apply(a, Aa);
    box.apply(b, Ab);
    A.multiply(a, Ma);
    const double scale = algebra::norm(Aa);
    EXPECT_NEAR(algebra::dot(b, Aa), algebra::dot(a, Ab), 1e-13 * scale * algebra::norm(b));
    algebra::axpy(-1, Aa, Ma);
    EXPECT_LT(algebra::norm(Ma), 1e-13 * scale);
  }
}

TEST_P(HangingNode, GivesItsWeightToItsMastersAndIsNeverInContact) {
  const auto m = with_hanging_nodes(GetParam(), test::flat);
  const auto shell = shell_on(m, element::Formulation::tangent);
  double area = 0;
  for (const NodalPoint& point : shell->points) {
    EXPECT_GE(point.weight, 0);
    area += point.weight;
  }
  EXPECT_NEAR(area, 2, 1e-13);
  for (const constraints::Row& row : m.space->continuity.rows()) {
    EXPECT_EQ(shell->points[static_cast<std::size_t>(row.node)].weight, 0);
    EXPECT_FALSE(shell->coordinates.is_touchable(static_cast<std::size_t>(row.node)));
    for (const constraints::Term& term : row.terms)
      EXPECT_TRUE(shell->coordinates.is_touchable(static_cast<std::size_t>(term.node)));
  }
}

INSTANTIATE_TEST_SUITE_P(OfDegree, HangingNode, testing::Range(1, 6));

}  // namespace
}  // namespace plastron::assembly
