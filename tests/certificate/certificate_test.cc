// Every row of the certificate detects its own error. A solved shell on a table is corrupted, and the row must leave its
// limit.
// Tests also check which rows a corruption leaves alone. So the rows are not eight copies of one number.
#include "assembly/sample_shells.hpp"
#include "supported.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/certificate/certificate_limits.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/domain/domain.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <ostream>

namespace plastron::certificate {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;

constexpr double rounding = 1e-9;  // rows of the solution lie below it; corruptions lift them above 1000 times it
constexpr double clear = 1000 * rounding;

struct Sample {
  std::string name;
  domain::Domain domain;
  std::array<std::string, 3> chart;
  double table;
  std::string clamped;
  mesh::Shape shape;
  int degree, refinements;
  element::Formulation formulation = element::Formulation::tangent;
  bool is_flat() const { return chart == test::flat; }
};
void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

Sample plate(mesh::Shape shape, int degree, int refinements) {
  return {.name = (shape == test::triangle ? "plate_triangles_" : "plate_quadrilaterals_") + std::to_string(degree),
          .domain = domain::Rectangle{},
          .chart = test::flat,
          .table = 0.3 - 0.05 - 0.002,
          .clamped = "left",
          .shape = shape,
          .degree = degree,
          .refinements = refinements};
}

Sample bowl(element::Formulation formulation) {
  return {.name = "bowl_" + std::string(to_string(formulation)),
          .domain = domain::Disk{.radius = 0.8},
          .chart = test::cap,
          .table = -0.05 - 0.001,
          .clamped = "rim",
          .shape = test::quadrilateral,
          .degree = 2,
          .refinements = 2,
          .formulation = formulation};
}

/// A solution with contact, to be corrupted.
struct Solved {
  test::MeshedSurface mesh;
  std::unique_ptr<assembly::DiscreteShell> discrete;
  solution::NodalSolution nodal;

  Certificate certificate() const { return certify(*discrete, nodal).certificate; }
  /// The rows that exceed their limits.
  std::vector<std::string> broken_rows() const {
    std::vector<std::string> rows;
    for (const CertificateLimit& limit : certificate_limits(certify(*discrete, nodal), discrete->tangency.formulation))
      if (!limit.holds()) rows.emplace_back(limit.row);
    return rows;
  }
  bool touches(std::size_t i) const { return nodal.touching.local()[i] != 0; }
  std::size_t owned() const { return static_cast<std::size_t>(mesh.space->layout->owned); }
  double largest_displacement() const { return algebra::max_abs(nodal.y); }
};

Solved solve(const Sample& sample) {
  Solved s{.mesh = test::meshed(sample.domain, sample.chart, sample.degree, sample.refinements, sample.shape),
           .discrete = nullptr,
           .nodal = {}};
  const obstacle::HalfSpace table{.point = {0, 0, sample.table}};
  energy::AreaLoad load{};
  load.force[2] = geometry::Expression(sample.is_flat() ? "-1e-4*(1 + x*y)" : "-1e-3*(1 + 0.1*x)", {});
  s.discrete = assembly::discretise(s.mesh.space, s.mesh.surface,
                                    {.sections = test::steel_of(geometry::Expression(0.1)),
                                     .tangency = {.formulation = sample.formulation},
                                     .supports = {test::clamp(sample.clamped)},
                                     .loads = {.on_areas = {load}},
                                     .obstacles = {.all = {{.shape = table}}}});
  const algebra::Matrix A = assembly::stiffness_matrix(*s.discrete);
  algebra::Factorisation F(A);
  const contact::BoxProblem box = assembly::box_problem(*s.discrete, A);
  const contact::BoxSolution solution = contact::solve_primal_dual_active_set(box, {}, F);
  EXPECT_EQ(solution.status, contact::Status::solved);
  s.nodal = solution::nodal_solution(*s.discrete, solution);
  return s;
}

/// The owned node nearest to a place among those that fulfil a condition; empty on the ranks that do not own it.
template <class Condition>
std::optional<std::size_t> node_near(const Solved& s, const Eigen::Vector2d& place, const Condition& condition) {
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < s.owned(); ++i) {
    const double distance = (s.discrete->points[i].x - place).norm();
    if (!condition(i) || distance >= nearest) continue;
    nearest = distance;
    found = i;
  }
  const double overall = algebra::min_over_ranks(nearest, MPI_COMM_WORLD);
  EXPECT_TRUE(std::isfinite(overall)) << "no node fulfils the condition";
  return nearest == overall ? found : std::nullopt;
}

/// Each sample is solved once. Tests corrupt a copy of its nodal values and loads.
Solved& solved_once(const Sample& sample) {
  static std::map<std::string, Solved> all;
  const auto found = all.find(sample.name);
  return found != all.end() ? found->second : all.emplace(sample.name, solve(sample)).first->second;
}

class Rows : public testing::TestWithParam<Sample> {
 protected:
  ~Rows() override {
    solved.nodal = nodal_before;
    solved.discrete->load = load_before;
  }

  Solved& solved = solved_once(GetParam());
  const solution::NodalSolution nodal_before = solved.nodal;
  const algebra::Vector load_before = solved.discrete->load;
  const Certificate rest = solved.certificate();

  /// Adds to one value of (u, r) at the node; does nothing on ranks without the node.
  void move(std::optional<std::size_t> node, int component, double by) {
    if (node) solved.nodal.y.local()[6 * *node + static_cast<std::size_t>(component)] += by;
    solved.nodal.y.update_ghosts();
  }
  std::optional<std::size_t> touching_node() const {
    const Eigen::Vector2d place = GetParam().is_flat() ? Eigen::Vector2d(0.81, 0.47) : Eigen::Vector2d(0.013, 0.007);
    return node_near(solved, place, [&](std::size_t i) { return solved.touches(i); });
  }
  std::optional<std::size_t> free_node() const {
    const Eigen::Vector2d place = GetParam().is_flat() ? Eigen::Vector2d(0.24, 0.51) : Eigen::Vector2d(0.41, 0.02);
    return node_near(solved, place, [&](std::size_t i) {
      return !solved.touches(i) && !test::is_supported(solved.discrete->coordinates, i);
    });
  }
  double max_pressure() const { return algebra::max_abs(solved.nodal.pressure); }
};

INSTANTIATE_TEST_SUITE_P(OfTheCertificate, Rows,
                         testing::Values(plate(test::quadrilateral, 2, 3), plate(test::quadrilateral, 1, 4),
                                         plate(test::triangle, 1, 3), plate(test::triangle, 2, 2),
                                         bowl(element::Formulation::tangent), bowl(element::Formulation::penalised),
                                         bowl(element::Formulation::mixed), bowl(element::Formulation::classical)),
                         [](const auto& sample) { return sample.param.name; });

TEST_P(Rows, AreAtRoundingForTheSolutionItself) {
  const bool is_covariant = GetParam().formulation == element::Formulation::classical;
  EXPECT_GT(algebra::max_abs(solved.nodal.touching), 0);
  EXPECT_LT(rest.stationarity, rounding);
  EXPECT_LT(rest.energy_identity, rounding);
  // Rigid motions are exact in Cartesian components, so forces balance. Moments, and covariant components, balance up to h.
  EXPECT_LT(rest.force_balance, is_covariant ? 1e-3 : rounding);
  EXPECT_LT(rest.moment_balance, GetParam().is_flat() ? rounding : 1e-3);
  EXPECT_GT(rest.min_pressure, 0);
  EXPECT_GT(rest.min_gap_nodes, -1e-12);
  EXPECT_LT(rest.support_error, rounding * solved.largest_displacement());
  EXPECT_LT(rest.complementarity, rounding * max_pressure() * solved.largest_displacement());
  EXPECT_LE(rest.min_gap_between, rest.min_gap_nodes + 1e-12);
  EXPECT_GT(rest.min_gap_between, -0.1 * solved.largest_displacement());
  EXPECT_THAT(solved.broken_rows(), IsEmpty());
}

TEST_P(Rows, StationarityNoticesAFreeNodeThatIsMoved) {
  move(free_node(), 2, 1e-4 * solved.largest_displacement());
  EXPECT_GT(solved.certificate().stationarity, clear);
  EXPECT_THAT(solved.broken_rows(), Contains("stationarity"));
}

TEST_P(Rows, StationarityNoticesARotationThatIsChanged) {
  move(free_node(), 3, 1e-2 * solved.largest_displacement());
  EXPECT_GT(solved.certificate().stationarity, clear);
  EXPECT_THAT(solved.broken_rows(), Contains("stationarity"));
}

TEST_P(Rows, StationarityNoticesASupportedNodeThatIsMoved) {
  const auto held = node_near(solved, GetParam().is_flat() ? Eigen::Vector2d(0, 0.4) : Eigen::Vector2d(0.8, 0.1),
                              [&](std::size_t i) { return test::is_supported(solved.discrete->coordinates, i); });
  move(held, 0, 1e-4 * solved.largest_displacement());
  EXPECT_GT(solved.certificate().stationarity, clear);
  EXPECT_THAT(solved.broken_rows(), Contains("stationarity"));
}

TEST_P(Rows, MinPressureNoticesAPressureOfTheWrongSignAndTheBalanceToo) {
  const auto node = touching_node();
  double turned = 0;
  if (node) turned = solved.nodal.pressure.local()[*node] *= -1;
  turned = algebra::min_over_ranks(turned, MPI_COMM_WORLD);
  ASSERT_LT(turned, 0);
  solved.nodal.pressure.update_ghosts();
  const Certificate c = solved.certificate();
  EXPECT_EQ(c.min_pressure, turned);
  EXPECT_THAT(solved.broken_rows(), Contains("min_pressure"));
  EXPECT_GT(c.stationarity, clear);
  EXPECT_GT(c.force_balance, clear);
}

TEST_P(Rows, MinGapAtNodesAndComplementarityNoticeATouchingNodeInTheObstacle) {
  const double depth = 0.01 * solved.largest_displacement();
  const auto node = touching_node();
  move(node, 2, -depth);
  const double pressure = algebra::max_over_ranks(node ? solved.nodal.pressure.local()[*node] : 0, MPI_COMM_WORLD);
  const Certificate c = solved.certificate();
  EXPECT_NEAR(c.min_gap_nodes, -depth, 1e-6 * depth);
  EXPECT_THAT(solved.broken_rows(), Contains("min_gap_nodes"));
  EXPECT_NEAR(c.complementarity, pressure * depth, 1e-6 * pressure * depth);
}

TEST_P(Rows, ComplementarityNoticesATouchingNodeThatIsLiftedWhileItsPressureStays) {
  const double height = 0.01 * solved.largest_displacement();
  const auto node = touching_node();
  move(node, 2, height);
  const double pressure = algebra::max_over_ranks(node ? solved.nodal.pressure.local()[*node] : 0, MPI_COMM_WORLD);
  const Certificate c = solved.certificate();
  EXPECT_NEAR(c.complementarity, pressure * height, 1e-6 * pressure * height);
  EXPECT_THAT(solved.broken_rows(), Contains("complementarity"));
  EXPECT_GT(c.min_gap_nodes, -1e-12);  // this row cannot detect it
}

// The basis function of a vertex is -1/8 of its height between the nodes (degree 2). The gaps of the neighbours add to it.
TEST_P(Rows, MinGapBetweenNodesNoticesAWaveThatLeavesAllNodesOutside) {
  if (GetParam().degree == 1) GTEST_SKIP() << "bilinear and linear waves have their lowest points at nodes";
  const double height = 0.5 * solved.largest_displacement();
  const double spacing = std::pow(0.5, GetParam().refinements);
  const auto is_vertex = [&](std::size_t i) {
    const Eigen::Vector2d x = solved.discrete->points[i].x;
    if (GetParam().shape == test::triangle) return solved.discrete->points[i].weight == 0;  // no bound at vertices
    if (!solved.touches(i)) return false;
    if (!GetParam().is_flat()) return x.norm() < 1e-12;
    return std::abs(std::remainder(x[0], spacing)) < 1e-9 && std::abs(std::remainder(x[1], spacing)) < 1e-9;
  };
  const Eigen::Vector2d inside = GetParam().is_flat() ? Eigen::Vector2d(0.8, 0.45) : Eigen::Vector2d(0, 0);
  const auto vertex = node_near(solved, inside, is_vertex);
  move(vertex, 2, height);
  const Certificate c = solved.certificate();
  EXPECT_LT(c.min_gap_between, rest.min_gap_between - 0.05 * height);
  EXPECT_GT(c.min_gap_nodes, -1e-12);  // no node is inside the obstacle
}

TEST_P(Rows, TheBalanceOfForcesNoticesALoadThatWasNotTheSolutionsOne) {
  const auto load = solved.discrete->load.local();
  for (std::size_t i = 2; i < load.size(); i += 6) load[i] *= 1.01;
  const Certificate c = solved.certificate();
  EXPECT_GT(c.force_balance, 1e-3);
  EXPECT_GT(c.stationarity, 1e-3);
  EXPECT_GT(c.energy_identity, 1e-3);
  if (GetParam().formulation != element::Formulation::classical) {
    EXPECT_THAT(solved.broken_rows(), Contains("force_balance"));
  }
}

TEST_P(Rows, TheBalanceOfForcesNoticesAReactionThatIsTooSmall) {
  for (double& pressure : solved.nodal.pressure.local()) pressure *= 0.99;
  const Certificate c = solved.certificate();
  EXPECT_GT(c.force_balance, 1e-4);
  EXPECT_GT(c.stationarity, 1e-4);
}

// A shell that slides along the table has the same strains and contact as before. Only its supports can show it.
TEST_P(Rows, SupportErrorNoticesAShellThatSlidOffItsSupports) {
  const double slide = 0.01 * solved.largest_displacement();
  for (std::size_t i = 0; i < solved.nodal.y.local().size(); i += 6) solved.nodal.y.local()[i] += slide;
  EXPECT_NEAR(solved.certificate().support_error, slide, 1e-9 * slide);
  if (GetParam().is_flat()) {
    EXPECT_THAT(solved.broken_rows(), ElementsAre("support_error"));
  } else {
    EXPECT_THAT(solved.broken_rows(), Contains("support_error"));
  }
}

// A couple has no resultant force. Only the moments can show it.
TEST_P(Rows, TheBalanceOfMomentsNoticesACoupleThatTheBalanceOfForcesCannotSee) {
  double most = 0;
  for (std::size_t i = 0; i < solved.owned(); ++i)
    most = std::max(most, std::abs(solved.discrete->load.local()[6 * i + 2]));
  const auto node = free_node();
  if (node) solved.discrete->load.local()[6 * *node + 3] += 1000 * most;
  const Certificate c = solved.certificate();
  EXPECT_GT(c.moment_balance, rest.moment_balance + 1e-2);
  EXPECT_THAT(solved.broken_rows(), Contains("moment_balance"));
  EXPECT_LE(c.force_balance, rest.force_balance + rounding);
}

// a(U, U) grows with the square of the factor, the work with the factor itself.
TEST_P(Rows, TheEnergyIdentityNoticesDisplacementsThatAreTooLarge) {
  const Verdict rest = certify(*solved.discrete, solved.nodal);
  const double a = 2 * (rest.summary.energy.total() + rest.summary.tangency_energy), loads = rest.summary.load_work;
  for (double& value : solved.nodal.y.local()) value *= 1.001;
  const double largest = std::max({1.001 * a, std::abs(loads), std::abs(a - loads)});
  EXPECT_NEAR(solved.certificate().energy_identity, 0.001 * a / largest, 1e-5);
  EXPECT_THAT(solved.broken_rows(), Contains("energy_identity"));
}

TEST_P(Rows, StationarityAndEnergyNoticeADisplacementThatIsNoNumber) {
  move(free_node(), 2, std::nan(""));
  EXPECT_THAT(solved.broken_rows(), IsSupersetOf({"stationarity", "energy_identity"}));
}

// If no node touches, only the depth between the nodes shows the missed contact.
TEST_P(Rows, MinGapBetweenNodesHasALimitWhereNoNodeTouches) {
  solved.nodal.touching.fill(0);
  const double depth = algebra::max_over_ranks(-rest.min_gap_between, MPI_COMM_WORLD);
  for (std::size_t i = 2; i < solved.nodal.y.local().size(); i += 6) solved.nodal.y.local()[i] -= 0.01;
  EXPECT_LT(solved.certificate().min_gap_between, -0.009 - depth);
  EXPECT_THAT(solved.broken_rows(), Contains("min_gap_between"));
}

TEST(MixedRows, StationarityNoticesAMultiplierOfTheTangencyThatIsWrong) {
  Solved s = solve(bowl(element::Formulation::mixed));
  ASSERT_TRUE(s.nodal.lambda.layout());
  ASSERT_GT(algebra::max_abs(s.nodal.lambda), 0);
  for (double& value : s.nodal.lambda.local()) value *= 1.01;
  EXPECT_GT(s.certificate().stationarity, clear);
  EXPECT_THAT(s.broken_rows(), Contains("stationarity"));
}

}  // namespace
}  // namespace plastron::certificate
