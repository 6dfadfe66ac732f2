// Edges on rigid bodies: closed forms of beams, hinges, supports of a body, and refusals; alike on all ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/algebra/pseudo_random.hpp>
#include <plastron/assembly/box_problem.hpp>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/fem/constraints.hpp>
#include <plastron/meshing/sequence.hpp>

#include <Eigen/Dense>

#include <numbers>

#include "computation/problems.hpp"
#include "larger.hpp"

namespace plastron::computation::rigid_bodies_test {
namespace {

using namespace test;
using Eigen::Vector3d;
using element::Formulation;

constexpr auto open = std::nullopt;
constexpr double young = 1e4, thickness = 0.05, width = 0.25, length = 1;
constexpr double bending_stiffness = young * width * thickness * thickness * thickness / 12;

/// A strip along x without lateral contraction, clamped at x = 0. Its other end is on a body with the reference point at its middle.
problem::Problem beam(const fem::RigidBody& body) {
  problem::Problem p = free_plate();
  p.domain = domain::Rectangle{.to = {length, width}, .cells = {4, 1}};
  p.shell.sections.common.thickness = Expression(thickness);
  p.shell.sections.common.material = shell::Material::from_young_poisson(young, 0, 1);
  p.shell.supports = {clamped("left")};
  p.discretisation = {.degree = 3, .refinements = 1};
  p.rigid_bodies = {body};
  return p;
}

fem::RigidBody end_plate() { return {.name = "plate", .boundaries = {"right"}, .reference = {length, width / 2, 0}}; }

std::unique_ptr<assembly::DiscreteShell> discretised(const problem::Problem& p, MPI_Comm comm = MPI_COMM_WORLD) {
  fem::MeshSequence meshes = meshing::mesh_sequence(p, comm);
  for (int i = 0; i < p.discretisation.refinements; ++i) meshes.refine({});
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, p.charts);
  return assembly::discretise(meshes.space(), surface, p.shell, {});
}

void expect_sound(const Result& result) {
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_LT(result.certificate.stationarity, 1e-9);
  EXPECT_LT(result.certificate.force_balance, 1e-9);
  EXPECT_LT(result.certificate.moment_balance, 1e-9);
  EXPECT_LT(result.certificate.energy_identity, 1e-9);
  EXPECT_LT(result.certificate.support_error, 1e-12);
}

// A body with finite rotations turns the shell on it without strain.
TEST(RigidBodyWithFiniteRotations, TurnsItsShellByAnyAngle) {
  for (const double angle : {0.3, 1.2}) {
    problem::Problem p = beam({.name = "holder",
                               .boundaries = {"left"},
                               .reference = {0, width / 2, 0},
                               .fixed = {0.0, 0.0, 0.0, 0.0, angle, 0.0}});
    p.shell.supports.clear();
    p.shell.rotations = element::Rotations::finite;
    const Result r = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_LT(r.summary.energy.total(), 1e-12 * young * thickness);
    EXPECT_NEAR(r.summary.max_displacement, 2 * std::sin(angle / 2) * length, 1e-9);
    EXPECT_NEAR(r.summary.body_reactions.at(0).rotation[1], angle, 1e-9);
    EXPECT_LT(r.certificate.support_error, 1e-9);
  }
}

struct Element {
  mesh::Shape cells;
  int degree;
  Formulation formulation;
};

class RigidBody : public testing::TestWithParam<Element> {
 protected:
  static problem::Problem on_cells(problem::Problem p) {
    const auto [cells, degree, formulation] = GetParam();
    p.discretisation.cells = cells;
    p.discretisation.degree = degree;
    p.shell.tangency.formulation = formulation;
    if (cells == mesh::Shape::triangle) p.shell.tying = false;
    return p;
  }
};

INSTANTIATE_TEST_SUITE_P(Each, RigidBody,
                         testing::Values(Element{mesh::Shape::quadrilateral, 2, Formulation::tangent},
                                         Element{mesh::Shape::quadrilateral, 3, Formulation::penalised},
                                         Element{mesh::Shape::quadrilateral, 2, Formulation::mixed},
                                         Element{mesh::Shape::quadrilateral, 2, Formulation::classical},
                                         Element{mesh::Shape::triangle, 2, Formulation::tangent}));

TEST_P(RigidBody, TurnsTheTipOfACantileverByMLOverEI) {
  fem::RigidBody body = end_plate();
  body.moment = {0, 1e-4, 0};
  const Result result = solve(on_cells(beam(body)), MPI_COMM_WORLD);
  expect_sound(result);
  const double turn = body.moment[1] * length / bending_stiffness;
  const auto& moved = result.summary.body_reactions.at(0);
  EXPECT_NEAR(moved.rotation[1], turn, 1e-9 * turn);
  EXPECT_NEAR(moved.displacement[2], -turn * length / 2, 1e-9 * turn);
  EXPECT_LT(std::hypot(moved.rotation[0], moved.rotation[2]), 1e-9 * turn);
  EXPECT_EQ(moved.reaction.force.norm(), 0);
  EXPECT_NEAR(result.summary.loads.moment[1], body.moment[1], 1e-12 * body.moment[1]);
  EXPECT_NEAR(result.summary.load_work, body.moment[1] * turn, 1e-9 * body.moment[1] * turn);
  EXPECT_NEAR(result.summary.support_reaction.moment[1], -body.moment[1], 1e-9 * body.moment[1]);
}

/// Curved, so that normals and levers differ from node to node.
problem::Problem curved(problem::Problem p) {
  p.charts = {{"", Chart({"x", "y", "0.4*x*(1 - x) + 0.3*y^2"}, {})}};
  return p;
}

/// The coordinate that is component `axis` of the displacement, at a node that keeps the unknowns of a rigid body.
int body_coordinate(const assembly::NodalCoordinates& coordinates, std::size_t node, int axis) {
  int k = 0;
  while (coordinates.basis[node](axis, k) == 0) ++k;
  return k;
}

/// The rigid motion u = c + w x phi with the coordinates that it has: those of the nodes, and the bodies' own.
algebra::Vector coordinates_of_motion(const assembly::DiscreteShell& shell, const algebra::Vector& y, const Vector3d& c,
                                      const Vector3d& w) {
  const assembly::NodalCoordinates& coordinates = shell.coordinates;
  algebra::Vector z(shell.space().layout, coordinates.width);
  for (std::size_t i = 0; i < coordinates.basis.size(); ++i) {
    const Eigen::VectorXd own = coordinates.basis[i]
                                    .leftCols(coordinates.width)
                                    .colPivHouseholderQr()
                                    .solve(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(&y.local()[6 * i]));
    std::ranges::copy(own, z.local().begin() + static_cast<std::ptrdiff_t>(coordinates.at(i, 0)));
  }
  for (const fem::PlacedBody& placed : shell.space().bodies)
    for (int k = 0; k < 6; ++k) {
      const auto host = placed.hosts[k < 3 ? 0 : 1];
      if (host < 0) continue;
      const auto node = static_cast<std::size_t>(host);
      const Vector3d d = c + w.cross(placed.body.reference);
      z.local()[coordinates.at(node, body_coordinate(coordinates, node, k % 3))] =
          k < 3 ? d[k] : placed.length * w[k - 3];
    }
  return z;
}

TEST_P(RigidBody, LeavesAllRigidMotionsFreeOfStrain) {
  for (const bool is_flat : {true, false}) {
    problem::Problem p = on_cells(is_flat ? beam(end_plate()) : curved(beam(end_plate())));
    p.shell.supports.clear();
    p.rigid_bodies.push_back(
        {.name = "hinge", .boundaries = {"left"}, .reference = {-0.3, 0, 0.2}, .turns_normals = false});
    if (is_flat) p.rigid_bodies[1].fixed[4] = 0;  // its nodes lie on a line along y
    const auto shell = discretised(p);
    algebra::Vector y(shell->space().layout, 6), through_map(y);
    for (int k = 0; k < 6; ++k) {
      const Vector3d c = k < 3 ? Vector3d::Unit(k) : Vector3d(0.1, 0.2, 0.3),
                     w = k < 3 ? Vector3d(0, 0, 0) : Vector3d::Unit(k - 3);
      for (std::size_t i = 0; i < shell->points.size(); ++i)
        Eigen::Map<Eigen::Matrix<double, 6, 1>>(&y.local()[6 * i]) << c + w.cross(shell->points[i].phi),
            w.cross(shell->points[i].a3);
      shell->coordinates.to_cartesian(coordinates_of_motion(*shell, y, c, w), through_map);
      for (std::size_t i = 0; i < y.local().size(); ++i) ASSERT_NEAR(through_map.local()[i], y.local()[i], 1e-13);
      const fem::PlacedBody& plate = shell->space().bodies[0];
      const fem::BodyMotion motion = motion_of(shell->space(), plate, y);
      EXPECT_LT((motion.displacement - c - w.cross(plate.body.reference)).norm(), 1e-11);
      EXPECT_LT((motion.rotation - w).norm(), 1e-11);
      // On the curved strip the space interpolates normals (and covariant components). Bodies do not change this.
      const double energy = shell->shell.energies(through_map).total();
      if (is_flat) {
        EXPECT_LT(energy, 1e-24);
      } else {
        EXPECT_NEAR(energy, shell->shell.energies(y).total(), 1e-9 * energy + 1e-24);
      }
    }
  }
}

TEST_P(RigidBody, LeavesTheFormSymmetricAndPositiveAndTheMatrixTheOperator) {
  problem::Problem p = on_cells(curved(beam(end_plate())));
  p.rigid_bodies.push_back({.name = "hinge",
                            .boundaries = {"top"},
                            .reference = {0.5, 1, 1},
                            .turns_normals = false,
                            .fixed = {0.0, 0.0, 0.0, open, open, 0.01}});
  p.shell.supports.clear();
  p.domain = domain::Rectangle{.to = {length, width}, .cells = {4, 2}};
  p.rigid_bodies[0].boundaries = {"bottom"};
  const auto shell = discretised(p);
  const algebra::Matrix A = stiffness_matrix(*shell);
  const contact::BoxProblem box = box_problem(*shell, A);
  algebra::Vector a(shell->space().layout, shell->coordinates.width), b(a), Aa(a), Ab(a), Ma(a);
  algebra::fill_with_pseudo_random_values(a, 1);
  algebra::fill_with_pseudo_random_values(b, 2);
  a.update_ghosts();
  b.update_ghosts();
  box.apply(a, Aa);
  box.apply(b, Ab);
  A.multiply(a, Ma);
  const double scale = algebra::norm(Aa);
  EXPECT_NEAR(algebra::dot(b, Aa), algebra::dot(a, Ab), 1e-13 * scale * algebra::norm(b));
  EXPECT_GT(algebra::dot(a, Aa), 0);
  algebra::axpy(-1, Aa, Ma);
  EXPECT_LT(algebra::norm(Ma), 1e-13 * scale);
}

/// Timoshenko: w = F (L^3 / (12 or 3 E I) + L / (G A)) with the shear factor 1 of the material.
double beam_flexibility(double number) {
  return length * length * length / (number * bending_stiffness) + length / (young / 2 * width * thickness);
}

TEST(RigidBodies, ThatAreHeldCarryWhatABeamWithGuidedEndsPushesBack) {
  fem::RigidBody body = end_plate();
  constexpr double sink = -0.02;
  body.fixed = {open, open, sink, 0.0, 0.0, 0.0};
  const Result result = solve(beam(body), MPI_COMM_WORLD);
  expect_sound(result);
  const auto& plate = result.summary.body_reactions.at(0);
  const double force = sink / beam_flexibility(12);
  EXPECT_EQ(plate.displacement[2], sink);
  EXPECT_NEAR(plate.reaction.force[2], force, 1e-8 * std::abs(force));
  EXPECT_NEAR(plate.moment_at_reference[1], force * length / 2, 1e-8 * std::abs(force));
  EXPECT_NEAR(result.summary.support_reaction.force.norm(), 0, 1e-8 * std::abs(force));
}

TEST(RigidBodies, MayBeHingesThatTakeNoMoment) {
  fem::RigidBody body = end_plate();
  constexpr double sink = -0.02;
  body.turns_normals = false;
  body.fixed = {open, open, sink, open, 0.0, open};
  const Result result = solve(beam(body), MPI_COMM_WORLD);
  expect_sound(result);
  const auto& hinge = result.summary.body_reactions.at(0);
  const double force = sink / beam_flexibility(3);
  EXPECT_NEAR(hinge.reaction.force[2], force, 1e-8 * std::abs(force));
  EXPECT_NEAR(hinge.moment_at_reference.norm(), 0, 1e-9 * std::abs(force));
}

/// Cross-sections of a tube turn as a whole, psi R / 2 = gamma_sy and psi = chi_sy: T = psi G 2 pi R e (R^2 + e^2 / 3).
TEST(RigidBodies, TwistATubeWhoseSeamIsJoined) {
  constexpr double wall = 0.05, pi = std::numbers::pi, moment = 1e-4;
  problem::Problem p;
  p.domain = domain::Rectangle{.to = {2 * pi, 2}, .cells = {8, 2}};
  p.charts = {{"", Chart({"sin(x)", "y", "cos(x)"}, {})}};
  p.shell.sections.common.thickness = Expression(wall);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.joins = {{{"left", "right"}}};
  p.shell.supports = {clamped("bottom")};
  p.discretisation = {.degree = 4, .refinements = 0};
  p.rigid_bodies = {{.name = "plate", .boundaries = {"top"}, .reference = {0, 2, 0}, .moment = {0, moment, 0}}};
  const Result result = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  const double turn = 2 * moment / (2 * pi * wall / 2.6 * (1 + wall * wall / 3));
  const auto& plate = result.summary.body_reactions.at(0);
  EXPECT_LT((plate.rotation - Vector3d(0, turn, 0)).norm(), 1e-5 * turn);
  EXPECT_LT(plate.displacement.norm(), 1e-9 * turn);
  EXPECT_NEAR(result.summary.support_reaction.moment[1], -moment, 1e-6 * moment);
}

TEST(RigidBodies, OfAnotherReferencePointMoveAlike) {
  fem::RigidBody body = end_plate();
  body.force = {0, 0.1e-4, -1e-4};
  body.moment = {1e-5, 0, 2e-6};
  const Result one = solve(beam(body), MPI_COMM_WORLD);
  const Vector3d by{0.7, -0.4, 0.3};
  body.reference += by;
  body.moment -= by.cross(body.force);
  const Result two = solve(beam(body), MPI_COMM_WORLD);
  expect_sound(one);
  expect_sound(two);
  EXPECT_NEAR(one.summary.energy.total(), two.summary.energy.total(), 1e-9 * one.summary.energy.total());
  const auto &a = one.summary.body_reactions.at(0), &b = two.summary.body_reactions.at(0);
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-9 * a.rotation.norm());
  EXPECT_LT((a.displacement + a.rotation.cross(by) - b.displacement).norm(), 1e-9 * a.displacement.norm());
}

/// A plate at the tip presses the strip on a table that lies only below its middle.
problem::Problem pressed_by_its_tip() {
  fem::RigidBody body = end_plate();
  body.fixed = {open, open, -0.06, open, open, open};
  problem::Problem p = beam(body);
  p.discretisation.degree = 2;
  p.discretisation.refinements = 2;
  p.shell.sections.common.material = shell::Material::from_young_poisson(young, 0.3, 1);
  p.shell.obstacles.all = {
      obstacle::Obstacle{.shape = obstacle::HalfSpace{.point = {0.5, 0, -0.035}, .normal = {-0.2, 0, 1}}}};
  return p;
}

TEST(RigidBodies, PressAShellOnAnObstacleAlikeOnAnyNumberOfRanks) {
  const problem::Problem p = pressed_by_its_tip();
  const Result here = solve(p, MPI_COMM_SELF), all = solve(p, MPI_COMM_WORLD);
  expect_sound(all);
  EXPECT_GT(all.summary.touching_nodes, 2);
  EXPECT_EQ(all.summary.touching_nodes, here.summary.touching_nodes);
  EXPECT_NEAR(all.summary.energy.total(), here.summary.energy.total(), 1e-12 * here.summary.energy.total());
  const auto &a = here.summary.body_reactions.at(0), &b = all.summary.body_reactions.at(0);
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-12 * a.rotation.norm());
  EXPECT_LT((a.reaction.force - b.reaction.force).norm(), 1e-11 * a.reaction.force.norm());
  EXPECT_LT(b.reaction.force[2], 0);
}

// A column L with a rigid arm a beyond its end, where a dead force presses: k a tan(k L) = 1, P = k^2 E I. The force does work at
// second order in the turn of the arm.
TEST(RigidBodies, WithALoadOnTheirArmBuckleTheirColumn) {
  for (const element::Rotations rotations : {element::Rotations::small, element::Rotations::finite})
    for (const double arm : {0.0, 0.4, 1.0, -0.3}) {
      fem::RigidBody body = end_plate();
      body.reference[0] += arm;
      body.force = {-1e-3 * bending_stiffness, 0, 0};
      problem::Problem p = beam(body);
      p.shell.rotations = rotations;
      p.modes.buckling = 1;
      const Result r = solve(p, MPI_COMM_WORLD);
      ASSERT_EQ(r.modes.size(), 1U);
      double low = 0, high = arm < 0 ? std::numbers::pi : std::numbers::pi / 2;  // of k L
      for (int i = 0; i < 60; ++i) {
        const double k = (low + high) / 2;
        (k * arm * std::sin(k) < std::cos(k) ? low : high) = k;
      }
      const double shear = 5.0 / 12 * young * width * thickness, load = low * low * bending_stiffness;
      EXPECT_NEAR(r.modes[0].value * (1 + load / shear) / (1e3 * low * low), 1, 2e-3) << arm;  // Engesser
    }
}

TEST(RigidBodies, MayBeHeldBySymmetryWhereTheyAreFixedAlike) {
  fem::RigidBody body = end_plate();
  body.force = {0, 0, -1e-4};
  const Result whole = solve(beam(body), MPI_COMM_WORLD);
  body.force /= 2;
  body.reference[1] = 0;
  body.fixed = {open, 0.0, open, 0.0, open, 0.0};
  problem::Problem p = beam(body);
  p.domain = domain::Rectangle{.to = {length, width / 2}, .cells = {4, 1}};
  p.shell.supports.push_back(symmetry("bottom"));
  const Result half = solve(p, MPI_COMM_WORLD);
  expect_sound(half);
  EXPECT_NEAR(2 * half.summary.energy.total(), whole.summary.energy.total(), 1e-9 * whole.summary.energy.total());
}

TEST(RigidBodies, ThatEnterAnObstacleAreWarnedOf) {
  const auto warnings = [](double sink) {
    problem::Problem p = pressed_by_its_tip();
    p.rigid_bodies[0].fixed[2] = sink;
    return solve(p, MPI_COMM_WORLD).warnings;
  };
  EXPECT_THAT(warnings(0.3), testing::Not(testing::Contains(testing::HasSubstr("\"plate\" takes the shell"))));
  EXPECT_THAT(warnings(-0.06), testing::Contains(testing::HasSubstr("\"plate\" takes the shell")));
}

std::string refusal(const problem::Problem& p) {
  try {
    solve(p, MPI_COMM_WORLD);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

using testing::HasSubstr;

TEST(RigidBodies, AreRefusedWhereTheyMakeNoSense) {
  fem::RigidBody body = end_plate();
  body.boundaries = {"west"};
  EXPECT_THAT(refusal(beam(body)), HasSubstr("rigid body \"plate\" is not there: there is no boundary \"west\""));
  problem::Problem p = beam(end_plate());
  p.rigid_bodies.push_back({.name = "rail", .boundaries = {"top"}});
  EXPECT_THAT(refusal(p), HasSubstr("\"plate\" and \"rail\" both carry the node at (1, 0.25, 0)"));
  body = end_plate();
  body.turns_normals = false;
  EXPECT_THAT(refusal(beam(body)), HasSubstr("free to turn about the line"));
  body.fixed[4] = 0;
  body.moment = {0, 1, 0};
  EXPECT_THAT(refusal(beam(body)), HasSubstr("has a part about the line"));
}

TEST(RigidBodies, AreNotHeldBySupportsOfTheirNodes) {
  problem::Problem p = beam(end_plate());
  p.shell.supports.push_back(held("right", {Direction::z}));
  EXPECT_THAT(refusal(p), HasSubstr("where the rigid body \"plate\" carries it"));
  p.rigid_bodies[0].fixed = {open, open, -0.01, 0.0, 0.0, open};
  EXPECT_THAT(refusal(p), HasSubstr("a support contradicts the rigid body \"plate\""));
  p.rigid_bodies[0].fixed[2] = 0;
  EXPECT_EQ(refusal(p), "");
}

TEST(RigidBodies, HoldTheShellAgainstRigidMotions) {
  problem::Problem p = beam(end_plate());
  p.shell.supports.clear();
  const auto errors = [&] {
    int count = 0;
    for (const auto& finding : examination::examine(p)) count += finding.severity == examination::Severity::error;
    return count;
  };
  EXPECT_EQ(errors(), 6);
  p.rigid_bodies[0].fixed = {0.0, 0.0, 0.0, open, open, 0.0};
  EXPECT_EQ(errors(), 2);
  p.rigid_bodies[0].fixed = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(errors(), 0);
}

}  // namespace
}  // namespace plastron::computation::rigid_bodies_test
