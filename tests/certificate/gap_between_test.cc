// The gap between the nodes, against polynomials and surfaces whose lowest point is known.
#include "assembly/sample_shells.hpp"

#include <plastron/certificate/gap_between.hpp>
#include <plastron/domain/domain.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace plastron::certificate {
namespace {

constexpr double thickness = 0.2;
constexpr double flat_gap = 0.2;  // test::flat lies at 0.3, its lower face half a thickness lower

/// The table z = 0 or another half-space; the lower face touches it.
assembly::RigidObstacles over(const obstacle::HalfSpace& table) { return {.all = {{.shape = table}}}; }

struct Shell {
  test::MeshedSurface mesh;
  std::unique_ptr<assembly::DiscreteShell> discrete;
};

Shell shell_over(const obstacle::HalfSpace& table, const domain::Domain& domain,
                 const std::array<std::string, 3>& chart, mesh::Shape shape, int degree,
                 element::Formulation formulation = element::Formulation::tangent) {
  Shell s{test::meshed(domain, chart, degree, 0, shape), nullptr};
  s.discrete = assembly::discretise(s.mesh.space, s.mesh.surface,
                                    {.sections = test::steel_of(geometry::Expression(thickness)),
                                     .tangency = {.formulation = formulation},
                                     .obstacles = over(table)});
  return s;
}

/// (u, r) at every node as a function of the node.
template <class Field>
algebra::Vector nodal(const Shell& s, const Field& field) {
  algebra::Vector y(s.mesh.space->layout, 6);
  for (std::size_t i = 0; i < s.discrete->points.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> value = field(s.discrete->points[i]);
    for (std::size_t k = 0; k < 6; ++k) y.local()[6 * i + k] = value[static_cast<Eigen::Index>(k)];
  }
  return y;
}

algebra::Vector at_rest(const Shell& s) {
  return nodal(
      s, [](const assembly::NodalPoint&) { return Eigen::Matrix<double, 6, 1>(Eigen::Matrix<double, 6, 1>::Zero()); });
}

Eigen::Matrix<double, 6, 1> downwards(double u_z) {
  Eigen::Matrix<double, 6, 1> y = Eigen::Matrix<double, 6, 1>::Zero();
  y[2] = u_z;
  return y;
}

/// The smallest gap of all cells near the table, over all ranks.
double least_gap(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  double least = std::numeric_limits<double>::infinity();
  for (const CellGap& cell : searched_gaps(discrete, y)) least = std::min(least, cell.gap);
  return algebra::min_over_ranks(least, MPI_COMM_WORLD);
}

/// All elements that a plane table permits.
std::vector<std::pair<mesh::Shape, int>> elements() {
  return {{test::quadrilateral, 1},
          {test::quadrilateral, 2},
          {test::quadrilateral, 4},
          {test::triangle, 1},
          {test::triangle, 2}};
}

TEST(GapBetween, OfAPlaneFaceIsThatOfItsLowestCorner) {
  for (const auto& [shape, degree] : elements()) {
    const Shell s = shell_over({}, test::skew(), test::flat, shape, degree);
    const auto y =
        nodal(s, [](const assembly::NodalPoint& p) { return downwards(-0.19 - 0.05 * p.x[0] + 0.02 * p.x[1]); });
    EXPECT_NEAR(least_gap(*s.discrete, y), flat_gap - 0.19 - 0.05 + 0.02 * 0.1, 1e-14) << "degree " << degree;
  }
}

// The basis function of a vertex falls to -1/8 between the nodes of either shape.
TEST(GapBetween, OfAVertexLiftedOffTheTableIsAnEighthOfTheLiftBelowIt) {
  constexpr double lift = 0.08;
  for (const auto shape : {test::quadrilateral, test::triangle}) {
    const Shell s = shell_over({}, test::skew(), test::flat, shape, 2);
    const auto y = nodal(
        s, [](const assembly::NodalPoint& p) { return downwards(p.x.norm() < 1e-12 ? lift - flat_gap : -flat_gap); });
    EXPECT_NEAR(least_gap(*s.discrete, y), -lift / 8, 1e-14);
  }
}

TEST(GapBetween, OfElementsOfDegreeOneIsNeverLowerThanTheirNodesOnAPlaneTable) {
  for (const auto shape : {test::quadrilateral, test::triangle}) {
    const Shell s = shell_over({}, test::skew(), test::flat, shape, 1);
    const auto y =
        nodal(s, [](const assembly::NodalPoint& p) { return downwards(p.x.norm() < 1e-12 ? 0.1 : -flat_gap); });
    EXPECT_NEAR(least_gap(*s.discrete, y), 0, 1e-14);
  }
}

// All nodes have the same height, so nodal gaps do not show the dip between them.
TEST(GapBetween, SeesADipOfTheSurfaceThatNoNodeHas) {
  const std::array<std::string, 3> dip{"x", "y", "0.3 - x*(1 - x)"};
  for (const auto& [shape, degree] : {std::pair{test::quadrilateral, 1}, std::pair{test::triangle, 1}}) {
    const Shell s = shell_over({}, domain::Rectangle{}, dip, shape, degree);
    EXPECT_NEAR(least_gap(*s.discrete, at_rest(s)), 0.3 - 0.25 - thickness / 2, 1e-14);
  }
}

// n . (u - e/2 r) with inclined n: the part of r along a_3 does not count (D2).
TEST(GapBetween, FeelsTheRotationOfTheFaceWithoutItsPartAlongTheNormal) {
  const obstacle::HalfSpace inclined{.point = {2, 0, 0}, .normal = {-0.6, 0, 0.8}};
  for (const auto& [shape, degree] : elements()) {
    const Shell s = shell_over(inclined, domain::Rectangle{}, test::flat, shape, degree);
    const double at_edge = 0.6 * (2 - 1) + 0.8 * flat_gap;  // x = 1
    const auto y = nodal(s, [](const assembly::NodalPoint&) {
      return (Eigen::Matrix<double, 6, 1>() << 0.1, 0, -0.2, -0.5, 0.3, 7).finished();
    });
    const double change = -0.6 * (0.1 - thickness / 2 * -0.5) + 0.8 * -0.2;
    EXPECT_NEAR(least_gap(*s.discrete, y), at_edge + change, 1e-14) << "degree " << degree;
  }
}

// u = c a_3 has constant covariant components. (M15) keeps it exact between the nodes; Cartesian components do not.
TEST(GapBetween, InterpolatesAsTheFormulationDoes) {
  const std::array<std::string, 3> cylinder{"x", "y", "1 - sqrt(1 - x^2)"};
  const domain::Rectangle domain{.from = {-0.3, 0}, .to = {0.5, 1}};
  constexpr double c = 0.06, middle = 0.1;  // the middle of the cell is the lowest point of the lattice
  const double expected = 1 + (c - thickness / 2 - 1) * std::sqrt(1 - middle * middle);
  const auto lowest = [&](element::Formulation formulation) {
    const Shell s = shell_over({}, domain, cylinder, test::quadrilateral, 1, formulation);
    return least_gap(*s.discrete, nodal(s, [&](const assembly::NodalPoint& p) {
      return (Eigen::Matrix<double, 6, 1>() << c * p.a3, Vector3d::Zero()).finished();
    }));
  };
  EXPECT_NEAR(lowest(element::Formulation::classical), expected, 1e-14);
  EXPECT_GT(std::abs(lowest(element::Formulation::tangent) - expected), 1e-3);
}

// Far smaller than the spacing of the lattice, and in the middle between its points.
TEST(GapBetween, IsSearchedForBodiesSmallerThanACell) {
  const obstacle::Ball ball{.centre = {0.4375, 0.4375, 0.3 - thickness / 2 + 0.002}, .radius = 0.005};
  for (const auto& [shape, degree] : elements()) {
    Shell s = shell_over({}, domain::Rectangle{}, test::flat, shape, degree);
    s.discrete->obstacles.all = s.discrete->obstacles_at_start.all = {{.name = "ball", .shape = ball}};
    const std::vector<CellGap> cells = searched_gaps(*s.discrete, at_rest(s));
    const auto deepest = std::ranges::min_element(cells, {}, &CellGap::gap);
    if (deepest == cells.end()) continue;  // on another rank
    if (deepest->gap > 0) continue;
    EXPECT_NEAR(deepest->gap, -0.007, 1e-3) << "degree " << degree;
    EXPECT_LT((deepest->x - ball.centre.head<2>()).norm(), 0.005);
  }
  const Shell s = shell_over({}, domain::Rectangle{}, test::flat, test::quadrilateral, 2);
  s.discrete->obstacles.all = s.discrete->obstacles_at_start.all = {{.name = "ball", .shape = ball}};
  EXPECT_NEAR(least_gap(*s.discrete, at_rest(s)), -0.007, 1e-3);
}

TEST(GapBetween, IsInfiniteWithoutAnObstacleAndWhereNoCellIsNearIt) {
  const auto infinity = std::numeric_limits<double>::infinity();
  Shell s = shell_over({.point = {0, 0, -50}}, test::skew(), test::flat, test::quadrilateral, 2);
  EXPECT_EQ(least_gap(*s.discrete, at_rest(s)), infinity);
  s = shell_over({}, test::skew(), test::flat, test::quadrilateral, 2);
  EXPECT_NEAR(least_gap(*s.discrete, at_rest(s)), flat_gap, 1e-14);
  s.discrete->obstacles = {};
  EXPECT_EQ(least_gap(*s.discrete, at_rest(s)), infinity);
}

}  // namespace
}  // namespace plastron::certificate
