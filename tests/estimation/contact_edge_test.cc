// Shares of the cells at a straight edge of contact. A plate is clamped above a table at one end and lies on it at the other. Nothing
// depends on y, so the shares follow from integrals along x.
#include <gtest/gtest.h>
#include <plastron/domain/domain.hpp>
#include <plastron/element/element_tables.hpp>
#include <plastron/estimation/contact_edge.hpp>
#include <plastron/mesh/basis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "estimation/solved_shell.hpp"

namespace plastron::estimation::contact_edge_test {
namespace {

using plastron::test::SolvedShell;

constexpr double thickness = 0.1, height = 0.3,
                 sag = 0.02;  ///< the lower face at the clamp is `sag` above the table [m]
constexpr int columns = 16;

/// A plate along x = xi_1 or, turned, along y, with this number of cells across.
SolvedShell lying_plate(int degree, int rows, bool is_turned) {
  energy::AreaLoad load{};
  load.force = {geometry::Expression(0.0), geometry::Expression(0.0), geometry::Expression(-0.02)};
  const auto direction = is_turned ? assembly::Direction::x : assembly::Direction::y;
  const auto symmetric = [&](const std::string& boundary) {  // nothing moves or turns across the plate
    assembly::Support support{.boundary = boundary, .components = {}};
    for (const auto unknown : {assembly::Unknown::displacement, assembly::Unknown::rotation})
      support.components.push_back({unknown, direction, geometry::Expression(0.0)});
    return support;
  };
  assembly::ShellDescription shell{.sections = plastron::test::steel_of(geometry::Expression(thickness)),
                                   .loads = {.on_areas = {load}}};
  shell.supports = is_turned ? std::vector{plastron::test::clamp("bottom"), symmetric("left"), symmetric("right")}
                             : std::vector{plastron::test::clamp("left"), symmetric("bottom"), symmetric("top")};
  obstacle::Obstacle table{};
  table.placement.translation = {0, 0, height - thickness / 2 - sag};
  shell.obstacles.all = {table};
  const domain::Rectangle along_x{.to = {1, 0.25}, .cells = {columns, rows}},
      along_y{.to = {0.25, 1}, .cells = {rows, columns}};
  return {plastron::test::meshed(is_turned ? along_y : along_x, plastron::test::flat, degree, 0), shell};
}

/// A derivative whose dual is the solution itself, so that both reactions are the pressure.
Derivative of_the_solution(const SolvedShell& plate) {
  Derivative derivative = zero_derivative(plate.solved());
  derivative.dual.load = plate.box().load;
  return derivative;
}

/// The dual of a multiple of the load.
DualSolution multiple(double factor, const SolvedShell& plate) {
  DualSolution dual{.z = plate.solution().z, .multiplier = plate.solution().multiplier};
  for (algebra::Vector* each : {&dual.z, &dual.multiplier})
    for (double& value : each->local()) value *= factor;
  return dual;
}

/// int p g and int p w over a cell, p the pressure between nodes, g the gap, w the deflection, by an own rule.
struct Integrals {
  double gap = 0, deflection = 0;
};
Integrals integrals(const SolvedShell& plate, std::size_t cell) {
  const fem::Space& space = plate.discrete().space();
  const mesh::Rule rule = mesh::gauss(space.degree + 3);
  const double area = space.cells[cell].size * space.cells[cell].size * 0.25 / static_cast<double>(space.global_cells);
  Integrals sum;
  for (std::size_t j = 0; j < rule.points.size(); ++j)
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const auto basis =
          element::basis_at(space.shape(), space.degree, {Eigen::Vector2d(rule.points[i], rule.points[j])});
      double p = 0, w = 0;
      for (int n = 0; n < space.nodes_per_cell(); ++n) {
        const auto node = static_cast<std::size_t>(space.nodes(cell)[static_cast<std::size_t>(n)]);
        p += basis.value(0, n) * plate.nodal().pressure.local()[node];
        w += basis.value(0, n) * plate.nodal().y.local()[6 * node + 2];
      }
      const double weight = area * rule.weights[i] * rule.weights[j];
      sum.gap += weight * p * (w + sag);
      sum.deflection += weight * p * w;
    }
  return sum;
}

struct Plate {
  int degree;
  bool is_turned;
};
void PrintTo(const Plate& plate, std::ostream* out) {
  *out << "degree " << plate.degree << (plate.is_turned ? ", turned" : "");
}

class AStraightEdge : public testing::TestWithParam<Plate> {};
INSTANTIATE_TEST_SUITE_P(Each, AStraightEdge,
                         testing::Values(Plate{1, false}, Plate{2, false}, Plate{2, true}, Plate{3, false},
                                         Plate{4, true}));

TEST_P(AStraightEdge, CrossesOneRowOfCellsWithEqualShares) {
  const auto [degree, is_turned] = GetParam();
  constexpr int rows = 3;
  const SolvedShell plate = lying_plate(degree, rows, is_turned);
  const Solved solved = plate.solved();
  const ContactEdge edge(solved);
  ASSERT_EQ(edge.crossed().size(), static_cast<std::size_t>(rows));
  EXPECT_TRUE(std::ranges::is_sorted(edge.crossed()));
  const EdgeShares shares = edge.shares(of_the_solution(plate), multiple(1, plate), plate.nodal().y);
  ASSERT_EQ(shares.all.size(), edge.crossed().size());
  for (std::size_t i = 0; i < edge.crossed().size(); ++i) {
    EXPECT_EQ(edge.across()[i], is_turned ? 1 : 0);
    EXPECT_EQ(edge.touching_nodes()[i], edge.touching_nodes()[0]);
    EXPECT_EQ(edge.touching_nodes()[i] % static_cast<std::size_t>(degree + 1), 0U);  // whole rows of nodes
    EXPECT_GT(shares.all[i], 0);
    EXPECT_NEAR(shares.all[i], shares.all[0], 1e-6 * shares.all[0]);
    EXPECT_EQ(shares.lines[i], 0);  // the zone is wide
  }
}

TEST_P(AStraightEdge, HasTheIntegralsOfPressureTimesGapAndTimesDeflectionAsShares) {
  const auto [degree, is_turned] = GetParam();
  const SolvedShell plate = lying_plate(degree, 2, is_turned);
  const Solved solved = plate.solved();
  const ContactEdge edge(solved);
  ASSERT_EQ(edge.crossed().size(), 2U);
  const EdgeShares shares = edge.shares(of_the_solution(plate), multiple(1, plate), plate.nodal().y);
  Derivative of_force = of_the_solution(plate);  // here the dual's deflection is compared with -1 at the table
  of_force.force_direction = Eigen::Vector3d::UnitZ();
  Derivative of_energy = of_the_solution(plate);  // with both reactions, and compared with the initial gap
  of_energy.weighs_gaps = true;
  const EdgeShares forces = edge.shares(of_force, multiple(1, plate), plate.nodal().y),
                   energies = edge.shares(of_energy, multiple(1, plate), plate.nodal().y);
  for (std::size_t i = 0; i < 2; ++i) {
    const Integrals sum = integrals(plate, edge.crossed()[i]);
    EXPECT_GT(std::abs(sum.gap), 0);
    const double pressure = (sum.gap - sum.deflection) / sag;  // int p
    const double work = std::abs(sum.deflection);
    EXPECT_NEAR(shares.all[i], std::max(std::abs(sum.gap), work), 1e-9 * work);
    EXPECT_NEAR(forces.all[i], std::max(std::abs(sum.gap), std::abs(sum.deflection + pressure)), 1e-9 * pressure);
    EXPECT_NEAR(energies.all[i], std::max(2 * std::abs(sum.gap), std::abs(sum.deflection - sag * pressure)),
                1e-9 * work);
  }
}

// A dual whose deflection is the value at which it is fixed leaves the penetration alone. Its reaction is twice the pressure here.
TEST_P(AStraightEdge, HasTheIntegralOfTheDualsReactionTimesGapAsShare) {
  const auto [degree, is_turned] = GetParam();
  const SolvedShell plate = lying_plate(degree, 2, is_turned);
  const Solved solved = plate.solved();
  const ContactEdge edge(solved);
  ASSERT_EQ(edge.crossed().size(), 2U);
  Derivative twice = of_the_solution(plate);
  algebra::axpy(1, plate.box().load, twice.dual.load);
  algebra::Vector y(plate.nodal().y.layout(), 6);
  const EdgeShares shares = edge.shares(twice, multiple(2, plate), y);
  twice.weighs_gaps = true;  // the dual is fixed at the initial gap, and both reactions count
  for (std::size_t i = 2; i < y.local().size(); i += 6) y.local()[i] = sag;
  const EdgeShares energies = edge.shares(twice, multiple(2, plate), y);
  for (std::size_t i = 0; i < 2; ++i) {
    const Integrals sum = integrals(plate, edge.crossed()[i]);
    const double rounding = 1e-9 * std::abs(sum.deflection);
    EXPECT_GT(std::abs(sum.gap), 1e3 * rounding);
    EXPECT_NEAR(shares.all[i], 2 * std::abs(sum.gap), rounding);
    EXPECT_NEAR(energies.all[i], 3 * std::abs(sum.gap), rounding);
  }
}

TEST_P(AStraightEdge, HasTheSameSumOfSharesWithMoreCellsAlongIt) {
  const Plate& given = GetParam();
  const auto sum = [&](int rows) {
    const SolvedShell plate = lying_plate(given.degree, rows, given.is_turned);
    const Solved solved = plate.solved();
    const EdgeShares shares = ContactEdge(solved).shares(of_the_solution(plate), multiple(1, plate), plate.nodal().y);
    return std::accumulate(shares.all.begin(), shares.all.end(), 0.0);
  };
  const double coarse = sum(2);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(sum(3), coarse, 1e-6 * coarse);
}

struct Pressed {
  std::string name;
  mesh::Shape cells = mesh::Shape::quadrilateral;
  int degree = 2;
  element::Formulation formulation = element::Formulation::tangent;
};
void PrintTo(const Pressed& pressed, std::ostream* out) { *out << pressed.name; }

class APressedObstacle : public testing::TestWithParam<Pressed> {};
INSTANTIATE_TEST_SUITE_P(
    Each, APressedObstacle,
    testing::Values(Pressed{"degree 1", mesh::Shape::quadrilateral, 1}, Pressed{"degree 2"},
                    Pressed{"degree 3", mesh::Shape::quadrilateral, 3},
                    Pressed{"degree 4", mesh::Shape::quadrilateral, 4},
                    Pressed{"triangles, degree 1", mesh::Shape::triangle, 1},
                    Pressed{"triangles, degree 2", mesh::Shape::triangle, 2},
                    Pressed{"penalised", mesh::Shape::quadrilateral, 2, element::Formulation::penalised},
                    Pressed{"mixed", mesh::Shape::quadrilateral, 2, element::Formulation::mixed},
                    Pressed{"classical", mesh::Shape::quadrilateral, 2, element::Formulation::classical}));

// A small force on a curved obstacle or shell: between nodes the gap is that of the undeformed shapes, much more than any
// displacement. The obstacle follows the shell, so numbers and errors are proportional to the force and its square.
TEST_P(APressedObstacle, HasRelativeErrorsThatDoNotDependOnASmallForce) {
  const Pressed& given = GetParam();
  const auto relative = [&](const obstacle::Shape& shape, const std::array<std::string, 3>& chart, double force) {
    assembly::ShellDescription shell{.sections = plastron::test::steel_of(geometry::Expression(thickness)),
                                     .supports = {plastron::test::clamp("left"), plastron::test::clamp("right")}};
    shell.tangency.formulation = given.formulation;
    shell.obstacles.all = {{.shape = shape, .face = obstacle::Face::upper, .force = {0, 0, -force}}};
    SolvedShell solved(plastron::test::meshed(domain::Rectangle{.cells = {5, 5}}, chart, given.degree, 0, given.cells),
                       shell);
    EXPECT_GT(std::ranges::count(solved.nodal().touching.owned(), 1.0), 0);
    const Estimates estimates = solved.estimates({{"energy", Energy{}}, {"sunk", ObstaclePosition{0}}});
    std::vector<double> errors;
    for (const GoalEstimate& goal : estimates.goals) errors.push_back(goal.error() / std::abs(goal.value));
    return errors;
  };
  const obstacle::Shape ball = obstacle::Ball{.centre = {0.47, 0.52, 1.5}, .radius = 0.7},
                        plane = obstacle::HalfSpace{.point = {0, 0, 1.5}, .normal = {0, 0, -1}};
  const std::array<std::string, 3> dome{"x", "y", "0.5 - 0.2*((x - 0.47)^2 + (y - 0.52)^2)"};
  for (const auto& [shape, chart] : {std::pair(ball, plastron::test::flat), std::pair(plane, dome)}) {
    const std::vector<double> small = relative(shape, chart, 1e-10), smaller = relative(shape, chart, 1e-12);
    EXPECT_NEAR(smaller[0], small[0], 1e-3 * small[0]);
    EXPECT_LT(smaller[0], 1);
  }
}

/// Nine cells of a plate clamped at the left, with contact that a test prescribes node by node.
struct NineCells {
  using Mark = std::function<bool(const Eigen::Vector2d& x)>;

  NineCells(int degree, const Mark& touches, obstacle::Bed bed = {})
      : plate(plastron::test::meshed(domain::Rectangle{.to = {1.2, 0.9}, .cells = {3, 3}}, plastron::test::flat, degree,
                                     0),
              {.sections = plastron::test::steel_of(geometry::Expression(thickness)),
               .supports = {plastron::test::clamp("left")},
               .obstacles = {.all = {{.face = obstacle::Face::lower, .bed = std::move(bed)}}}}),
        nodal(plate.nodal()) {
    for (std::size_t i = 0; i < plate.discrete().points.size(); ++i)
      nodal.touching.local()[i] = nodal.pressure.local()[i] = touches(plate.discrete().points[i].x) ? 1 : 0;
  }
  Solved solved() const {
    return {.discrete = plate.discrete(), .nodal = nodal, .box = plate.box(), .z = plate.solution()};
  }

  SolvedShell plate;
  solution::NodalSolution nodal;
};

// The cells in which some nodes touch and some do not, for drawn sets of nodes. On a bed pressures do not jump.
TEST(AnEdge, CrossesTheCellsWithTouchingAndFreeNodes) {
  std::mt19937 random(1);
  for (const int degree : {1, 2, 3})
    for (int draw = 0; draw < 20; ++draw) {
      std::bernoulli_distribution is_marked(0.1 + 0.8 * draw / 19);
      const auto touches = [&](const Eigen::Vector2d& x) {
        return (x - Eigen::Vector2d(0.6, 0.45)).cwiseAbs().maxCoeff() < 0.25 ||
               is_marked(random);  // a node inside: no line
      };
      const NineCells scene(degree, touches);
      const Solved solved = scene.solved();
      const ContactEdge edge(solved);
      const fem::Space& space = scene.plate.discrete().space();
      std::vector<std::size_t> crossed, touching;
      for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
        const auto count = std::ranges::count_if(space.nodes(cell), [&](auto node) {
          return scene.nodal.touching.local()[static_cast<std::size_t>(node)] > 0;
        });
        if (count == 0 || count == space.nodes_per_cell()) continue;
        crossed.push_back(cell);
        touching.push_back(static_cast<std::size_t>(count));
      }
      EXPECT_EQ(edge.crossed(), crossed);
      EXPECT_EQ(edge.touching_nodes(), touching);
      EXPECT_FALSE(edge.has_kinks());
    }
  const NineCells on_bed(
      2, [](const Eigen::Vector2d& x) { return x[0] > 0.5; }, obstacle::Bed(1e-3));
  EXPECT_TRUE(ContactEdge(on_bed.solved()).crossed().empty());
}

// A shell that stands on its rim has no edge inside, but the ends of the line on the sides of two cells, perhaps at corners.
TEST(AnEdge, OfALineOnTheRimIsWhereTheLineEnds) {
  for (const int degree : {1, 2, 4})
    for (const auto& [from, to] :
         {std::pair(-1.0, 2.0), std::pair(-1.0, 0.5), std::pair(0.1, 2.0), std::pair(0.3, 0.9)}) {
      const NineCells scene(
          degree, [from = from, to = to](const Eigen::Vector2d& x) { return x[1] < 1e-9 && x[0] > from && x[0] < to; });
      const Solved solved = scene.solved();
      const fem::Space& space = scene.plate.discrete().space();
      std::vector<std::size_t> ends;
      for (std::size_t cell = 0; cell < space.owned_cells; ++cell) {
        std::array<std::array<int, 2>, 4> counts{};  // free and touching nodes of the cell on each side of the plate
        for (const auto node : space.nodes(cell)) {
          const Eigen::Vector2d& x = scene.plate.discrete().points[static_cast<std::size_t>(node)].x;
          const std::array distances{x[0], 1.2 - x[0], x[1], 0.9 - x[1]};
          for (std::size_t k = 0; k < 4; ++k)
            if (distances[k] < 1e-9) ++counts[k][x[1] < 1e-9 && x[0] > from && x[0] < to ? 1 : 0];
        }
        if (std::ranges::any_of(counts, [](const auto& c) { return c[0] > 0 && c[1] > 0; })) ends.push_back(cell);
      }
      EXPECT_EQ(ends.size(), 2U);
      EXPECT_EQ(ContactEdge(solved).crossed(), ends) << degree << ", " << from << " to " << to;
    }
}

// All nodes touch but those that the clamp holds: the edge is between it and the next nodes.
TEST(AnEdge, BesideASupportIsHalfWayToItsFirstNodes) {
  for (const int degree : {1, 2, 4}) {
    const NineCells scene(degree, [](const Eigen::Vector2d& x) { return x[0] > 1e-9; });
    const Solved solved = scene.solved();
    const ContactEdge edge(solved);
    ASSERT_EQ(edge.crossed().size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(edge.across()[i], 0);
      ASSERT_TRUE(edge.at_support()[i].has_value());
      EXPECT_NEAR(*edge.at_support()[i], mesh::gauss_lobatto(degree + 1).points[1] / 2, 1e-14);
    }
  }
}

/// A cantilever plate over a ridge along y, near the row of nodes at x = 3/4. Cells on the sides of this row that are named are
/// divided: the nodes on the row between those of the other side hang.
SolvedShell plate_on_a_ridge(int degree, double ridge, bool divides_left, bool divides_right, bool is_turned) {
  constexpr int cells = 8;
  constexpr double row = 0.75, radius = 0.2;
  const auto turned = [&](const Eigen::Vector2d& x) { return is_turned ? Eigen::Vector2d(x[1], x[0]) : x; };
  const domain::Rectangle rectangle{.to = turned({1, 0.25}),
                                    .cells = is_turned ? std::array{2, cells} : std::array{cells, 2}};
  fem::MeshSequence meshes(domain::coarse_mesh(rectangle, mesh::Shape::quadrilateral), degree, MPI_COMM_WORLD);
  std::map<std::string, geometry::Chart> charts;
  charts.emplace("", geometry::Chart(plastron::test::flat, {}));
  const auto surface_of = [&] { return std::make_shared<const fem::Surface>(meshes.space()->coarse, charts); };
  std::vector<signed char> marks;
  for (const fem::Cell& cell : meshes.space()->cells) {
    const Eigen::Vector3d middle = surface_of()->frame(cell, {0.5, 0.5}, false).phi;
    const double beyond = (is_turned ? middle[1] : middle[0]) - row;
    marks.push_back(std::abs(beyond) < 1.0 / cells && (beyond < 0 ? divides_left : divides_right) ? 1 : 0);
  }
  marks.resize(meshes.space()->owned_cells);
  if (divides_left || divides_right) meshes.refine({}, marks);

  assembly::ShellDescription shell{.sections = plastron::test::steel_of(geometry::Expression(thickness))};
  energy::AreaLoad load{};
  load.force = {geometry::Expression(0.0), geometry::Expression(0.0), geometry::Expression(-5e-5)};
  shell.loads.on_areas = {load};
  shell.supports = {plastron::test::clamp(is_turned ? "bottom" : "left")};
  const Eigen::Vector2d at = turned({ridge, 0}), axis = turned({0, 1});
  shell.obstacles.all = {{.shape = obstacle::Cylinder{.point = {at[0], at[1], height - radius - thickness / 2 - sag},
                                                      .axis = {axis[0], axis[1], 0},
                                                      .radius = radius}}};
  return {{meshes.space(), surface_of()}, shell};
}

TEST(ALine, HasTheSameShareWhereCellsOnOneSideAreDivided) {
  int compared = 0;
  for (const int degree : {2, 3, 4})
    for (const bool is_turned : {false, true})
      for (const double ridge : {0.745, 0.75, 0.755, 0.76}) {
        const auto found = [&](bool left, bool right) {
          const SolvedShell plate = plate_on_a_ridge(degree, ridge, left, right, is_turned);
          const Solved solved = plate.solved();
          const EdgeShares shares =
              ContactEdge(solved).shares(of_the_solution(plate), multiple(1, plate), plate.nodal().y);
          return std::pair(plate.value(Energy{}), std::accumulate(shares.lines.begin(), shares.lines.end(), 0.0));
        };
        const auto [energy, line] = found(false, false);
        for (const auto& [left, right] : {std::pair(true, false), {false, true}}) {
          const auto [other_energy, other_line] = found(left, right);
          if (line == 0 || std::abs(other_energy - energy) > 1e-3 * energy) continue;  // another row of nodes touches
          ++compared;
          EXPECT_NEAR(other_line / line, 1, 0.1)
              << "degree " << degree << ", ridge " << ridge << (left ? ", left" : ", right") << is_turned;
        }
      }
  EXPECT_GT(compared, 12);
}

TEST(AnEdge, CrossesNoCellWithoutObstacle) {
  const assembly::ShellDescription shell{.sections = plastron::test::steel_of(geometry::Expression(thickness)),
                                         .supports = {plastron::test::clamp("left")}};
  const SolvedShell plate(plastron::test::meshed(domain::Rectangle{.cells = {2, 2}}, plastron::test::flat, 2, 0),
                          shell);
  const Solved solved = plate.solved();
  EXPECT_TRUE(ContactEdge(solved).crossed().empty());
}

}  // namespace
}  // namespace plastron::estimation::contact_edge_test
