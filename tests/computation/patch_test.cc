// Patch tests: states of constant strain and of constant curvature on a flat plate, prescribed along the whole boundary,
// must be exact in the interior, also on distorted meshes.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>

#include <cmath>

#include "computation/problems.hpp"
#include "larger.hpp"

namespace plastron::computation {
namespace {

using namespace test;

using Eigen::Vector3d;

struct State {
  std::string name;
  std::array<std::string, 3> u, r;     ///< as functions of x, y
  Vector3d couple = Vector3d::Zero();  ///< m that balances a constant shear force: int Q . s = int m . s
};

/// Stretching, shearing and turning in the plane.
State stretched() { return {"stretched", {"0.01*x + 0.02*y", "0.03*x - 0.02*y", "0"}, {"0", "0", "0"}}; }
/// r = - grad u_z: no shear, constant curvature.
State bent() {
  return {"bent", {"0", "0", "0.02*x^2 - 0.03*y^2 + 0.05*x*y"}, {"-0.04*x - 0.05*y", "0.06*y - 0.05*x", "0"}};
}
/// 2 delta = (0.03, 0.02).
State sheared() {
  const double k_e_mu = 0.1 * 1e4 / 2.6;
  return {"sheared", {"0", "0", "0.02*x - 0.01*y"}, {"0.01", "0.03", "0"}, k_e_mu * Vector3d(0.03, 0.02, 0)};
}
State rigid() { return {"rigid", {"0.1 - 0.2*y", "0.3 + 0.2*x", "0.1*x - 0.2*y"}, {"-0.1", "0.2", "0"}}; }

Support prescribed(const std::string& boundary, const State& state) {
  Support s{.boundary = boundary, .components = {}};
  constexpr Direction directions[3] = {Direction::x, Direction::y, Direction::z};
  for (std::size_t i = 0; i < 3; ++i) {
    s.components.push_back(fixed(Unknown::displacement, directions[i], Expression(state.u[i], {})));
    s.components.push_back(fixed(Unknown::rotation, directions[i], Expression(state.r[i], {})));
  }
  return s;
}

problem::Problem patch(const domain::Domain& domain, const State& state, int degree, bool tying, int refinements = 1) {
  problem::Problem p = free_plate();
  p.domain = domain;
  p.discretisation = {.degree = degree, .refinements = refinements};
  p.shell.tying = tying;
  p.shell.loads.on_areas.resize(1);
  p.shell.loads.on_areas[0].couple = vector(state.couple[0], state.couple[1], state.couple[2]);
  for (const std::string& boundary : domain::boundary_names(domain))
    p.shell.supports.push_back(prescribed(boundary, state));
  return p;
}

/// Largest error of u and r at the nodes.
double nodal_error(const problem::Problem& problem, const State& state) {
  const Result result = solve(problem, MPI_COMM_SELF);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  const auto& points = result.solution->discrete->points;
  double most = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto exact = [&](const std::string& text) { return Expression(text, {})(points[i].x[0], points[i].x[1]); };
      most = test::larger(most, std::abs(result.solution->nodal.y.local()[6 * i + c] - exact(state.u[c])));
      most = test::larger(most, std::abs(result.solution->nodal.y.local()[6 * i + 3 + c] - exact(state.r[c])));
    }
  return most;
}

const domain::Domain parallelogram = domain::Polygon{{{0, 0}, {2, 0.5}, {2.5, 1.7}, {0.5, 1.2}}};
const domain::Domain rectangle =
    domain::Rectangle{.to = {2, 1}, .cells = {3, 2}, .breaks = {0.7, 1.1}, .regions = {"", "", ""}};
const domain::Domain pentagon = domain::Polygon{{{0, 0}, {2, 0}, {2.4, 1}, {1, 1.8}, {-0.3, 0.9}}};

class Patch : public testing::TestWithParam<std::tuple<int, bool>> {
 protected:
  int degree = std::get<0>(GetParam());
  bool tying = std::get<1>(GetParam());
};

TEST_P(Patch, of_parallelograms_keeps_every_constant_state) {
  for (const domain::Domain& domain : {parallelogram, rectangle})
    for (const State& state : {rigid(), stretched(), sheared(), bent()}) {
      SCOPED_TRACE(state.name);
      // A bilinear element cannot bend without shear unless tied.
      if (state.name == "bent" && degree == 1 && !tying) continue;
      EXPECT_LT(nodal_error(patch(domain, state, degree, tying), state), 1e-12);
    }
}

// Tying interpolates along the cell's own coordinates. If a_1 and a_2 vary, a constant Cartesian state is in
// equilibrium only up to an error of higher order: gamma at every degree, the others at degree 1.
TEST_P(Patch, of_any_quadrilaterals_keeps_every_constant_state_up_to_what_tying_costs) {
  for (const State& state : {rigid(), stretched(), sheared(), bent()}) {
    SCOPED_TRACE(state.name);
    const auto error = [&](int refinements) {
      return nodal_error(patch(pentagon, state, degree, tying, refinements), state);
    };
    const bool beyond_degree = state.name == "bent" && degree == 1;
    const bool costs = tying && state.name != "rigid" && (state.name == "stretched" || degree == 1);
    const bool exact = !costs && !beyond_degree;
    const int refinements = !exact && degree == 1 ? 2 : 1;
    EXPECT_LT(error(refinements), exact ? 1e-12 : error(0) / std::pow(1.9, refinements * degree));
  }
}

TEST_P(Patch, of_constant_strain_has_constant_resultants) {
  const State state = stretched();
  problem::Problem p = patch(parallelogram, state, degree, tying);
  p.probes = {{.name = "a", .at = {0.6, 0.5}}, {.name = "b", .at = {1.25, 0.85}}, {.name = "c", .at = {2, 0.9}}};
  const Result result = solve(p, MPI_COMM_SELF);
  const double E = 1e4, nu = 0.3, e = 0.1, stiffness = E * e / (1 - nu * nu);
  const Vector3d N(stiffness * (0.01 - nu * 0.02), stiffness * (-0.02 + nu * 0.01), E * e / (2 * (1 + nu)) * 0.05);
  for (const ProbeValue& v : result.probes) {
    EXPECT_LT((v.values.N - N).norm(), 1e-10 * N.norm()) << v.name;
    EXPECT_LT(v.values.M.norm(), 1e-10 * N.norm() * e);
    EXPECT_LT(v.values.Q.norm(), 1e-10 * N.norm());
  }
  const double energy = 0.5 * (N[0] * 0.01 + N[1] * -0.02 + N[2] * 0.05) * 2.15;  // area of the parallelogram
  EXPECT_NEAR(result.summary.energy.total(), energy, 1e-10 * energy);
  EXPECT_NEAR(result.summary.energy.membrane, energy, 1e-10 * energy);
}

TEST_P(Patch, of_constant_curvature_has_constant_moments) {
  if (degree == 1 && !tying) return;
  problem::Problem p = patch(parallelogram, bent(), degree, tying);
  p.probes = {{.name = "a", .at = {0.6, 0.5}}, {.name = "b", .at = {1.25, 0.85}}, {.name = "c", .at = {2, 0.9}}};
  const Result result = solve(p, MPI_COMM_SELF);
  const double E = 1e4, nu = 0.3, e = 0.1, D = E * e * e * e / 12 / (1 - nu * nu);
  const Vector3d M(D * (-0.04 + nu * 0.06), D * (0.06 - nu * 0.04), D * (1 - nu) * -0.05);
  for (const ProbeValue& v : result.probes) EXPECT_LT((v.values.M - M).norm(), 1e-9 * M.norm()) << v.name;
}

INSTANTIATE_TEST_SUITE_P(Elements, Patch, testing::Combine(testing::Values(1, 2, 3), testing::Bool()),
                         [](const auto& test) {
                           return "degree" + std::to_string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) ? "_tied" : "_plain");
                         });

// Straight triangles have every constant strain in their space, and no tying that removes it.
TEST(TrianglePatch, keeps_every_constant_state_of_its_degree) {
  for (const domain::Domain& domain : {parallelogram, rectangle, pentagon})
    for (int k = 1; k <= 2; ++k)
      for (const State& state : {rigid(), stretched(), sheared(), bent()}) {
        if (k == 1 && state.name == "bent") continue;
        SCOPED_TRACE(state.name);
        problem::Problem p = patch(domain, state, k, false);
        p.discretisation.cells = mesh::Shape::triangle;
        EXPECT_LT(nodal_error(p, state), 1e-12) << "degree " << k;
      }
}

}  // namespace
}  // namespace plastron::computation
