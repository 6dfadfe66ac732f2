// A node that meets two obstacles at once. Independent contact rows are two of its coordinates; parallel ones are the two bounds of one (D4).
// The solver is compared with brute force over all active sets of a small shell.
#include <gtest/gtest.h>
#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/discrete_shell.hpp>
#include <plastron/certificate/certificate.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/domain/domain.hpp>
#include <plastron/geometry/frame.hpp>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <cmath>

#include "assembly/sample_shells.hpp"

namespace plastron::certificate::several_obstacles_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using obstacle::Face;
using obstacle::HalfSpace;

constexpr double thickness = 0.1;

struct Scene {
  const char* name;
  std::array<std::string, 3> chart;
  std::vector<obstacle::Obstacle> obstacles;
  Eigen::Vector3d force;
  element::Formulation formulation = element::Formulation::tangent;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

/// One cell, clamped at one side. Two nodes are free, with at most four contact rows.
std::unique_ptr<assembly::DiscreteShell> shell_of(const Scene& scene, bool with_obstacles) {
  const auto m = test::meshed(domain::Rectangle{}, scene.chart, 1, 0);
  energy::AreaLoad load;
  for (std::size_t k = 0; k < 3; ++k)
    load.force[k] = geometry::Expression(fmt::format("{}*(1 + y)", scene.force[static_cast<Index>(k)]), {});
  return assembly::discretise(m.space, m.surface,
                              {.sections = test::steel_of(geometry::Expression(thickness)),
                               .tangency = {.formulation = scene.formulation},
                               .supports = {test::clamp("left")},
                               .loads = {.on_areas = {load}},
                               .obstacles = {.all = with_obstacles ? scene.obstacles : decltype(scene.obstacles){}}});
}

/// min 1/2 x' K x - f' x with R x + g >= 0, by trying every set of rows as equations.
struct DenseProgram {
  MatrixXd K, R, to_y;  // y = to_y x
  VectorXd f, g;

  struct Solution {
    VectorXd y, reaction;
  };

  std::optional<Solution> with_equations(unsigned set) const {
    std::vector<Index> rows;
    for (Index i = 0; i < g.size(); ++i)
      if (set >> i & 1U) rows.push_back(i);
    const Index n = K.rows(), m = static_cast<Index>(rows.size());
    MatrixXd saddle = MatrixXd::Zero(n + m, n + m);
    VectorXd right(n + m);
    saddle.topLeftCorner(n, n) = K;
    right.head(n) = f;
    for (Index k = 0; k < m; ++k) {
      saddle.col(n + k).head(n) = -R.row(rows[static_cast<std::size_t>(k)]);
      saddle.row(n + k).head(n) = -R.row(rows[static_cast<std::size_t>(k)]);
      right[n + k] = g[rows[static_cast<std::size_t>(k)]];
    }
    const Eigen::FullPivLU<MatrixXd> lu(saddle);
    if (!lu.isInvertible()) return {};
    const VectorXd x = lu.solve(right);
    Solution s{to_y * x.head(n), VectorXd::Zero(g.size())};
    for (Index k = 0; k < m; ++k) s.reaction[rows[static_cast<std::size_t>(k)]] = x[n + k];
    const double most = s.reaction.cwiseAbs().maxCoeff();
    const bool is_feasible = (R * x.head(n) + g).minCoeff() > -1e-12, has_signs = s.reaction.minCoeff() > -1e-10 * most;
    return is_feasible && has_signs ? std::optional(s) : std::nullopt;
  }

  Solution solution() const {
    for (unsigned set = 0; set < 1U << g.size(); ++set)
      if (auto found = with_equations(set)) return *found;
    ADD_FAILURE() << "no active set fulfils the conditions";
    return {VectorXd::Zero(to_y.rows()), VectorXd::Zero(g.size())};
  }
};

/// On the free coordinates of the shell without obstacles. They are Cartesian combinations and do not depend on contact.
DenseProgram dense_program(const assembly::DiscreteShell& plain, const assembly::DiscreteShell& shell) {
  const auto& c = plain.coordinates;
  const auto nodes = c.basis.size();
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < nodes; ++i)
    for (int k = 0; k < c.width; ++k)
      if (!c.is_prescribed(i, k)) free.push_back(c.at(i, k));
  DenseProgram p;
  const auto n = static_cast<Index>(free.size()), size = static_cast<Index>(6 * nodes);
  p.to_y = MatrixXd::Zero(size, n);
  MatrixXd forces(size, n);
  algebra::Vector z(plain.space().layout, c.width), y(plain.space().layout, 6), force(y);
  for (Index j = 0; j < n; ++j) {
    z.fill(0);
    z.owned()[free[static_cast<std::size_t>(j)]] = 1;
    c.to_cartesian(z, y);
    plain.apply(y, force);
    p.to_y.col(j) = Eigen::Map<const VectorXd>(y.local().data(), size);
    forces.col(j) = Eigen::Map<const VectorXd>(force.local().data(), size);
  }
  p.K = p.to_y.transpose() * forces;
  p.f = p.to_y.transpose() * Eigen::Map<const VectorXd>(plain.load.local().data(), size);
  const auto& rows = shell.coordinates.rows;
  p.R = MatrixXd::Zero(static_cast<Index>(rows.size()), n);
  p.g = VectorXd::Zero(p.R.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const obstacle::Gap& gap = shell.coordinates.gaps[static_cast<std::size_t>(rows[i].obstacle)][rows[i].node];
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
    row.segment<3>(static_cast<Index>(6 * rows[i].node)) = gap.normal;
    row.segment<3>(static_cast<Index>(6 * rows[i].node + 3)) =
        gap.z * geometry::tangential(gap.normal, shell.points[rows[i].node].a3);
    p.R.row(static_cast<Index>(i)) = row * p.to_y;
    p.g[static_cast<Index>(i)] = gap.initial;
  }
  return p;
}

class SeveralObstacles : public testing::TestWithParam<Scene> {};

TEST_P(SeveralObstacles, AtOneNodeAreSolvedAsByBruteForce) {
  const auto shell = shell_of(GetParam(), true), plain = shell_of(GetParam(), false);
  const DenseProgram program = dense_program(*plain, *shell);
  const DenseProgram::Solution expected = program.solution();

  const algebra::Matrix A = assembly::stiffness_matrix(*shell);
  algebra::Factorisation F(A);
  const contact::BoxProblem box = assembly::box_problem(*shell, A);
  const contact::BoxSolution found = contact::solve_primal_dual_active_set(box, {}, F);
  ASSERT_EQ(found.status, contact::Status::solved);
  const solution::NodalSolution nodal = solution::nodal_solution(*shell, found);
  const Eigen::Map<const VectorXd> y(nodal.y.local().data(), expected.y.size());
  EXPECT_LT((y - expected.y).norm(), 1e-9 * expected.y.norm());

  const auto& rows = shell->coordinates.rows;
  const double most = expected.reaction.maxCoeff();
  int touching = 0, at_both = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t at = 2 * rows[i].node + static_cast<std::size_t>(rows[i].obstacle);
    const double force = nodal.pressure.owned()[at] * shell->points[rows[i].node].weight;
    EXPECT_NEAR(force, expected.reaction[static_cast<Index>(i)], 1e-8 * most);
    touching += nodal.touching.owned()[at] != 0;
    at_both += rows[i].obstacle == 1 && nodal.touching.owned()[at] != 0 && nodal.touching.owned()[at - 1] != 0;
  }
  EXPECT_GT(touching, 1);
  if (GetParam().name != std::string("between")) {
    EXPECT_GT(at_both, 0);
  }

  const Verdict verdict = certify(*shell, nodal);
  EXPECT_LT(verdict.certificate.stationarity, 1e-12);
  // Covariant interpolation does not contain rigid motions.
  EXPECT_LT(verdict.certificate.force_balance,
            GetParam().formulation == element::Formulation::classical ? 0.05 : 1e-12);
  EXPECT_LT(verdict.certificate.energy_identity, 1e-10);
  EXPECT_GT(verdict.certificate.min_gap_nodes, -1e-12);
  ASSERT_EQ(verdict.summary.obstacles.size(), 2U);
  EXPECT_LT((verdict.summary.obstacles[0].reaction.force + verdict.summary.obstacles[1].reaction.force -
             verdict.summary.reaction.force)
                .norm(),
            1e-15 * most);
}

obstacle::Obstacle body(const char* name, const Vector3d& point, const Vector3d& normal, Face face = Face::lower) {
  return {.name = name, .shape = HalfSpace{.point = point, .normal = normal.normalized()}, .face = face};
}

/// Level at the clamped edge, with the slope 0.5 at the free edge.
const std::array<std::string, 3> incline{"x", "y", "0.5*x^2*(x - 1)"};
const double half_slot = 0.49 * thickness / std::sqrt(1.25);

INSTANTIATE_TEST_SUITE_P(
    Scenes, SeveralObstacles,
    testing::Values(
        // Floor and wall: the free edge slides down on a flat sheet until both stop it.
        Scene{"corner",
              test::flat,
              {body("floor", {0, 0, 0.24}, {0, 0, 1}), body("wall", {1.001, 0, 0}, {-1, 0, 0.1})},
              {5e-3, 0, -2e-3}},
        Scene{"corner_penalised",
              test::flat,
              {body("floor", {0, 0, 0.24}, {0, 0, 1}), body("wall", {1.001, 0, 0}, {-1, 0, 0.1})},
              {5e-3, 0, -2e-3},
              element::Formulation::penalised},
        Scene{"corner_classical",
              {"x", "y", "0.3 + 0.1*x^2*(x - 1)"},
              {body("floor", {0, 0, 0.24}, {0, 0, 1}), body("wall", {1.01, 0, 0}, {-1, 0, 0.1})},
              {5e-3, 0, -2e-3},
              element::Formulation::classical},
        // Parallel rows on a flat sheet: one coordinate with two bounds. The load lifts one end and presses the other.
        Scene{"between",
              test::flat,
              {body("floor", {0, 0, 0.249}, {0, 0, 1}), body("ceiling", {0, 0, 0.351}, {0, 0, -1}, Face::upper)},
              {0, 0, -2e-3}},
        // A slot that is slightly too narrow for the inclined edge. The edge is squeezed at one node and must turn.
        Scene{"squeezed",
              incline,
              {body("floor", {1, 0, -half_slot}, {-0.02, 0, 1}),
               body("ceiling", {1, 0, half_slot}, {-0.02, 0, -1}, Face::upper)},
              {0, 0, -1e-5}},
        Scene{"squeezed_penalised",
              incline,
              {body("floor", {1, 0, -half_slot}, {-0.02, 0, 1}),
               body("ceiling", {1, 0, half_slot}, {-0.02, 0, -1}, Face::upper)},
              {0, 0, -1e-5},
              element::Formulation::penalised}),
    [](const auto& scene) { return std::string(scene.param.name); });

TEST(ContactRow, ThatDependsOnNearerOnesIsLeftOut) {
  const Scene scene{"three",
                    test::flat,
                    {body("left", {0, 0, -0.3}, {1, 0, 1}), body("middle", {0, 0, 0}, {0, 0, 1}),
                     body("right", {0, 0, 0}, {-1, 0, 1}), body("behind", {0, 0, -0.1}, {-1, 0, 3})},
                    {0, 0, -1}};
  const auto shell = shell_of(scene, true);
  int left_out = 0, independent = 0;
  for (const assembly::ContactRow& row : shell->coordinates.rows) {
    EXPECT_FALSE(row.is_left_out && row.is_touchable());
    left_out += row.is_left_out;
    independent += row.is_touchable();
    EXPECT_FALSE(row.is_left_out && row.node == 0 && row.obstacle == 1);  // the nearest there
  }
  EXPECT_GT(left_out, 0);
  EXPECT_GE(independent, left_out);
}

TEST(ContactRow, OfTheNearerOfTwoParallelObstaclesBinds) {
  const Scene scene{"parallel",
                    test::flat,
                    {body("deep", {0, 0, 0.1}, {0, 0, 1}), body("table", {0, 0, 0.2}, {0, 0, 1})},
                    {0, 0, -1}};
  const auto shell = shell_of(scene, true);
  int touchable = 0;
  for (const assembly::ContactRow& row : shell->coordinates.rows) {
    if (!row.is_touchable()) continue;
    ++touchable;
    EXPECT_EQ(row.coordinate, 0);
    EXPECT_EQ(row.binds, row.obstacle == 1);
  }
  EXPECT_EQ(touchable, 4);
}

}  // namespace
}  // namespace plastron::certificate::several_obstacles_test
