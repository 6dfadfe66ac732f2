// The four formulations (docs/model.md, section 5) on the same problems: rates, references, the multipliers.
#include "larger.hpp"
#include "verification/error_norm.hpp"
#include "verification/figures.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/algebra/factorisation.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/contact/solve.hpp>
#include <plastron/energy/normal_rotation.hpp>
#include <plastron/fem/mesh_sequence.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

namespace plastron::verification::formulations_test {
namespace {

using element::Formulation;

const auto* const figures = testing::AddGlobalTestEnvironment(new EveryFigureIsHeld("verification_formulations"));

constexpr std::array formulations{Formulation::tangent, Formulation::penalised, Formulation::mixed,
                                  Formulation::classical};

class InEachFormulation : public testing::TestWithParam<Formulation> {};
INSTANTIATE_TEST_SUITE_P(All, InEachFormulation, testing::ValuesIn(formulations),
                         [](const auto& parameters) { return std::string(element::to_string(parameters.param)); });

/// Energy errors on successive refinements of four distorted cells, or of the triangles that they are cut into.
std::vector<double> energy_errors(const Manufactured& exact, Formulation formulation, mesh::Shape shape, int degree,
                                  int first, int last) {
  std::vector<double> errors;
  for (int refinements = first; refinements <= last; ++refinements) {
    problem::Problem problem = manufactured_problem(exact, degree, refinements);
    problem.domain = domain::MeshFile{PLASTRON_MESH_DIR "/distorted-square.msh"};
    problem.shell.tangency.formulation = formulation;
    problem.discretisation.cells = shape;
    if (shape == mesh::Shape::triangle) problem.shell.tying = false;
    const computation::Result result = computation::solve(problem, MPI_COMM_WORLD);
    EXPECT_TRUE(is_solved_at_nodes(result)) << result.missed_limits;
    errors.push_back(energy_error(*result.solution, exact));
  }
  return errors;
}

TEST_P(InEachFormulation, TheManufacturedSolutionsAreReachedAtTheRateOfTheDegree) {
  for (const auto solution : {ManufacturedSolution::clamped, ManufacturedSolution::contact})
    for (int degree = 1; degree <= 3; ++degree) {
      const Manufactured exact(solution, {.thickness = 0.1});
      const int last = degree == 1 ? 5 : degree == 2 ? 4 : 3;
      const auto errors = energy_errors(exact, GetParam(), mesh::Shape::quadrilateral, degree, last - 2, last);
      const double mean = std::log2(errors.front() / errors.back()) / 2;
      fmt::print("{} ms{} degree {}: energy errors {:.3e}, rates {:.2f}\n", element::to_string(GetParam()),
                 solution == ManufacturedSolution::clamped ? 1 : 3, degree, fmt::join(errors, " "),
                 fmt::join(rates(errors), " "));
      // With contact the free boundary limits the rate.
      EXPECT_GT(mean, solution == ManufacturedSolution::clamped ? degree - 0.15 : std::min(degree, 2) - 0.2);
    }
}

TEST_P(InEachFormulation, TheManufacturedSolutionsAreReachedOnTriangles) {
  for (const auto solution : {ManufacturedSolution::clamped, ManufacturedSolution::contact})
    for (int degree = 1; degree <= 2; ++degree) {
      const Manufactured exact(solution, {.thickness = 0.3});  // thick: triangles are not tied against locking
      const int last = degree == 1 ? 5 : 4;
      const auto errors = energy_errors(exact, GetParam(), mesh::Shape::triangle, degree, last - 2, last);
      fmt::print("{} ms{} triangles degree {}: energy errors {:.3e}, rates {:.2f}\n", element::to_string(GetParam()),
                 solution == ManufacturedSolution::clamped ? 1 : 3, degree, fmt::join(errors, " "),
                 fmt::join(rates(errors), " "));
      EXPECT_GT(rates(errors).back(), degree - 0.2);
    }
}

TEST_P(InEachFormulation, ContactReferencesAreMetAtDegreeTwo) {
  for (const char* name : {"R4cap_e0.1_p0.02", "R2incl_al0.3_e0.1_p0.02", "R3_e0.1_P0.5"}) {
    ContactReference reference = contact_reference(name, 2, 4);
    reference.problem.shell.tangency.formulation = GetParam();
    const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved);
    EXPECT_LT(result.levels.back().unknowns, 60'000);
    const double energy = result.summary.energy.total() * reference.factor / reference.energy - 1;
    const double reaction = result.summary.reaction.force[2] * reference.factor / reference.reaction - 1;
    const std::string row = fmt::format("{}, {}", contact_reference_title(name), element::to_string(GetParam()));
    expect_figure("formulations", row, "unknowns", result.levels.back().unknowns);
    expect_figure("formulations", row, "energy", energy);
    expect_figure("formulations", row, "reaction", reaction);
    EXPECT_LT(std::abs(energy), 2e-3) << name;
    EXPECT_LT(std::abs(reaction), 2e-3) << name;
    EXPECT_LT(result.certificate.stationarity, 1e-9) << name;
    EXPECT_LT(result.certificate.energy_identity, 1e-9) << name;
    EXPECT_LT(result.certificate.force_balance, GetParam() == Formulation::classical ? 1e-5 : 1e-9) << name;
  }
}

TEST_P(InEachFormulation, TheClampedSaddleHasItsDeflectionToFourDigits) {
  LinearReference reference = clamped_saddle(4, 4);
  reference.problem.shell.tangency = {.formulation = GetParam(), .penalty = 1e-3};
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  const double u = result.probes.front().values.u.dot(reference.direction);
  expect_figure("clamped saddle", std::string(element::to_string(GetParam())), "u_3", -u);
  EXPECT_NEAR(u / reference.displacement, 1, 5e-5);
}

/// The right-hand side of lambda's own equation, int (M^{ab} b_{ab} + m . a_3) q sqrt(a) dx, with M from a solution.
algebra::Vector moment_potential_load(const computation::Solution& solution) {
  const energy::ShellOperator& shell = solution.discrete->shell;
  algebra::Vector load(shell.space().layout, 1);
  for (std::size_t c = 0; c < shell.space().owned_cells; ++c) {
    const auto stresses = shell.weighted_stresses(c, shell.strains(c, shell.gather(c, solution.nodal.y)));
    const auto nodes = shell.space().nodes(c);
    for (int q = 0; q < shell.tables().points_per_cell(); ++q) {
      const Eigen::Matrix2d& b = shell.point(c, q).frame.b_cov;
      const double density = stresses(q, 3) * b(0, 0) + stresses(q, 4) * b(1, 1) + 2 * stresses(q, 5) * b(0, 1);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        load.local()[static_cast<std::size_t>(nodes[i])] +=
            density * shell.tables().quadrature.value(q, static_cast<Eigen::Index>(i));
    }
  }
  load.accumulate_ghosts();
  return load;
}

/// || grad(lambda_h - lambda) || / || grad lambda ||, lambda from its own equation with M of the tangent formulation.
double multiplier_error(int refinements) {
  ContactReference reference = contact_reference("R4cap_e0.1_p0.02", 3, refinements);
  const computation::Result tangent = computation::solve(reference.problem, MPI_COMM_WORLD);
  reference.problem.shell.tangency.formulation = Formulation::mixed;
  const computation::Result mixed = computation::solve(reference.problem, MPI_COMM_WORLD);
  EXPECT_EQ(tangent.status, contact::Status::solved);
  EXPECT_EQ(mixed.status, contact::Status::solved);
  const auto& discrete = *mixed.solution->discrete;
  const algebra::Matrix gradients = energy::gradient_matrix(discrete.shell);
  algebra::Factorisation factor(gradients);
  const auto zeros = assembly::multiplier_zeros(discrete.coordinates, *discrete.space().layout);
  EXPECT_TRUE(factor.factorise(zeros));
  algebra::Vector load = moment_potential_load(*tangent.solution), lambda(load.layout(), 1);
  for (std::size_t i = 0; i < zeros.size(); ++i)
    if (zeros[i]) load.owned()[i] = 0;
  factor.solve(load, lambda);
  lambda.update_ghosts();
  const double norm = energy::gradient_norm(discrete.shell, lambda);
  algebra::axpy(-1, mixed.solution->nodal.lambda, lambda);
  lambda.update_ghosts();
  return energy::gradient_norm(discrete.shell, lambda) / norm;
}

TEST(Multiplier, LambdaConvergesToTheSolutionOfItsOwnEquation) {
  const double coarse = multiplier_error(1), middle = multiplier_error(2), fine = multiplier_error(3);
  fmt::print("lambda against its own equation: {:.2e} {:.2e} {:.2e}\n", coarse, middle, fine);
  EXPECT_LT(middle, 0.5 * coarse);
  EXPECT_LT(fine, 0.5 * middle);
  EXPECT_LT(fine, 0.02);
}

TEST(Multiplier, LambdaVanishesOnAFlatShell) {
  ContactReference reference = contact_reference("R3_e0.1_P0.5", 2, 2);
  reference.problem.shell.tangency.formulation = Formulation::mixed;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  ASSERT_GT(result.summary.load_work, 0);
  EXPECT_LT(result.summary.multiplier_norm, 1e-9 * result.summary.load_work);
}

TEST(Multiplier, EtaIntegratesToTheTotalReaction) {
  ContactReference reference = contact_reference("R4cap_e0.1_p0.02", 2, 3);
  reference.problem.shell.tangency.formulation = Formulation::mixed;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  ASSERT_GT(result.summary.reaction.force[2], 0);
  double sum = 0;
  const auto& points = result.solution->discrete->points;
  for (std::size_t i = 0; i < static_cast<std::size_t>(result.solution->discrete->space().layout->owned); ++i)
    sum += points[i].weight * result.solution->nodal.pressure.local()[i];
  EXPECT_NEAR(algebra::sum_over_ranks(sum, MPI_COMM_WORLD), result.summary.reaction.force[2],
              1e-12 * result.summary.reaction.force[2]);
}

// Theorem 4. The active set solves P_1, and eta is the residual. P_c is one linear system for (U, lambda, eta)
// once the zone is known, solved here densely. Both have the same (u, r), and eta is that residual.
TEST(Multiplier, TheMixedProblemAndTheReducedOneHaveTheSameSolutionAndItsResidualIsEta) {
  ContactReference reference = contact_reference("R4cap_e0.1_p0.02", 2, 1);
  problem::Problem& problem = reference.problem;
  problem.shell.tangency.formulation = Formulation::mixed;
  const computation::Result reduced = computation::solve(problem, MPI_COMM_SELF);
  ASSERT_EQ(reduced.status, contact::Status::solved);
  const auto& discrete = *reduced.solution->discrete;
  const algebra::Matrix matrix = assembly::stiffness_matrix(discrete);
  const contact::BoxProblem box = assembly::box_problem(discrete, matrix);
  const auto n = static_cast<Eigen::Index>(box.load.owned().size());
  const auto nodes = static_cast<Eigen::Index>(discrete.points.size());
  const auto& c = discrete.coordinates;

  std::vector<std::size_t> free, touching, multipliers;
  const auto zeros = assembly::multiplier_zeros(c, *discrete.space().layout);
  for (std::size_t i = 0; i < discrete.points.size(); ++i) {
    for (int k = 0; k < c.width; ++k)
      if (!c.is_prescribed(i, k)) free.push_back(c.at(i, k));
    if (reduced.solution->nodal.touching.local()[i] != 0) touching.push_back(i);
    if (!zeros[i]) multipliers.push_back(i);
  }
  ASSERT_GT(touching.size(), 4U);
  Eigen::MatrixXd A(n, n), B(nodes, n);
  algebra::Vector e(discrete.space().layout, c.width), column = e, q(discrete.space().layout, 1);
  for (Eigen::Index j = 0; j < n; ++j) {
    e.fill(0);
    e.local()[static_cast<std::size_t>(j)] = 1;
    box.apply(e, column);
    A.col(j) = Eigen::Map<const Eigen::VectorXd>(column.local().data(), n);
    box.equations->apply(e, q);
    B.col(j) = Eigen::Map<const Eigen::VectorXd>(q.local().data(), nodes);
  }
  const auto f = static_cast<Eigen::Index>(free.size()), m = static_cast<Eigen::Index>(multipliers.size()),
             t = static_cast<Eigen::Index>(touching.size());
  Eigen::MatrixXd saddle = Eigen::MatrixXd::Zero(f + m + t, f + m + t);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(f + m + t);
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  for (Eigen::Index i = 0; i < f; ++i) {
    right[i] = box.load.local()[free[static_cast<std::size_t>(i)]];
    for (Eigen::Index j = 0; j < f; ++j)
      saddle(i, j) = A(at(free[static_cast<std::size_t>(i)]), at(free[static_cast<std::size_t>(j)]));
    for (Eigen::Index j = 0; j < m; ++j)
      saddle(i, f + j) = saddle(f + j, i) =
          B(at(multipliers[static_cast<std::size_t>(j)]), at(free[static_cast<std::size_t>(i)]));
    for (Eigen::Index j = 0; j < t; ++j)
      if (free[static_cast<std::size_t>(i)] == c.at(touching[static_cast<std::size_t>(j)], 0))
        saddle(i, f + m + j) = saddle(f + m + j, i) = -discrete.points[touching[static_cast<std::size_t>(j)]].weight;
  }
  for (Eigen::Index j = 0; j < t; ++j) {
    const std::size_t node = touching[static_cast<std::size_t>(j)];
    right[f + m + j] = discrete.points[node].weight * c.rows[node].bound_gap;
  }
  const Eigen::VectorXd solution = saddle.fullPivLu().solve(right);

  algebra::Vector z(discrete.space().layout, c.width), y(discrete.space().layout, 6);
  for (Eigen::Index i = 0; i < f; ++i) z.local()[free[static_cast<std::size_t>(i)]] = solution[i];
  c.to_cartesian(z, y);
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < y.local().size(); ++i) {
    difference = test::larger(difference, std::abs(y.local()[i] - reduced.solution->nodal.y.local()[i]));
    size = std::max(size, std::abs(y.local()[i]));
  }
  EXPECT_LT(difference, 1e-8 * size);
  for (Eigen::Index j = 0; j < t; ++j) {
    const double eta = reduced.solution->nodal.pressure.local()[touching[static_cast<std::size_t>(j)]];
    EXPECT_GE(solution[f + m + j], 0);
    EXPECT_NEAR(solution[f + m + j], eta, 1e-6 * reduced.summary.max_pressure);
  }
  for (Eigen::Index j = 0; j < m; ++j)
    EXPECT_NEAR(solution[f + j], reduced.solution->nodal.lambda.local()[multipliers[static_cast<std::size_t>(j)]],
                1e-6 * reduced.summary.multiplier_norm);
}

// If the gap contained the whole r, the obstacle would push on r . a_3, which only the penalty holds: a compliant layer between
// shell and obstacle. This is the same discrete problem with the sixth coordinate changed in that way.
TEST(GapInRelaxedFormulations, WithTheWholeRotationThePenaltyWouldBeASoftLayer) {
  struct Outcome {
    double normal_rotation, penetration;
  };
  const auto solve_with = [](bool whole, double penalty) {
    problem::Problem problem = contact_reference("R4cap_e0.1_p0.02", 2, 2).problem;
    problem.shell.tangency = {.formulation = Formulation::penalised, .penalty = penalty};
    const computation::Result start = computation::solve(problem, MPI_COMM_WORLD);
    auto& discrete = *start.solution->discrete;
    if (whole)
      for (std::size_t i = 0; i < discrete.points.size(); ++i)
        if (discrete.coordinates.is_touchable(i)) {
          auto& basis = discrete.coordinates.basis[i];
          const auto& gap = discrete.coordinates.gaps[0][i];
          basis.col(5).head<3>() = -gap.z * gap.normal.dot(discrete.points[i].a3) * basis.col(0).head<3>();
        }
    const algebra::Matrix matrix = assembly::stiffness_matrix(discrete);
    algebra::Factorisation factorisation(matrix);
    const auto box = assembly::box_problem(discrete, matrix);
    const auto solved = contact::solve_primal_dual_active_set(box, {}, factorisation);
    EXPECT_EQ(solved.status, contact::Status::solved);
    algebra::Vector y(discrete.space().layout, 6);
    discrete.coordinates.to_cartesian(solved.z, y);
    Outcome outcome{0, 0};
    for (std::size_t i = 0; i < static_cast<std::size_t>(discrete.space().layout->owned); ++i) {
      const Eigen::Vector3d u = Eigen::Map<const Eigen::Vector3d>(y.local().data() + 6 * i),
                            r = Eigen::Map<const Eigen::Vector3d>(y.local().data() + 6 * i + 3);
      const Eigen::Vector3d& a3 = discrete.points[i].a3;
      outcome.normal_rotation = test::larger(outcome.normal_rotation, std::abs(r.dot(a3)));
      outcome.penetration =
          test::larger(outcome.penetration, -discrete.coordinates.gaps[0][i](u, geometry::tangential(r, a3)));
    }
    return outcome;
  };
  for (const double penalty : {1.0, 0.1}) {
    const Outcome right = solve_with(false, penalty), wrong = solve_with(true, penalty);
    fmt::print(
        "p = {:g}: largest |r . a_3| {:.1e} and penetration {:.1e}, with the whole r in the gap {:.1e} and {:.1e}\n",
        penalty, right.normal_rotation, right.penetration, wrong.normal_rotation, wrong.penetration);
    EXPECT_LT(right.penetration, 1e-10);
    EXPECT_GT(wrong.penetration, 1e-5);
    EXPECT_GT(wrong.normal_rotation, 3 * right.normal_rotation);
  }
}

}  // namespace
}  // namespace plastron::verification::formulations_test
