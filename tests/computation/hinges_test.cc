// Joined edges with hinges: beams and frames with closed forms, free and with a stiffness, with small and finite rotations.
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/meshing/sequence.hpp>
#include <research/spectra/spectra.hpp>

#include <cmath>
#include <vector>

#include "computation/problems.hpp"

namespace plastron::computation::hinges_test {
namespace {

using namespace test;
using Eigen::Vector3d;
using element::Formulation;

constexpr double young = 1e4, thickness = 0.05, bending_stiffness = young * thickness * thickness * thickness / 12,
                 shear_stiffness = young / 2 * thickness;

/// Strips of width 1: unit squares with x = 2k + s, y = t each, joined at seam_a and seam_b.
problem::Problem strip(const std::array<std::string, 3>& first, const std::array<std::string, 3>& second,
                       double stiffness) {
  problem::Problem p;
  p.domain = domain::MeshFile{.path = PLASTRON_TESTS_DIR "/computation/meshes/two-squares.msh"};
  p.charts.emplace("first", Chart(first, {}));
  p.charts.emplace("second", Chart(second, {}));
  p.shell.sections.common.thickness = Expression(thickness);
  p.shell.sections.common.material = shell::Material::from_young_poisson(young, 0, 1);
  p.discretisation = {.degree = 4, .refinements = 0};
  p.joins = {{.boundaries = {"seam_a", "seam_b"}, .is_hinge = true, .stiffness = stiffness}};
  return p;
}

problem::Problem folded(double angle, double stiffness) {
  const std::string c = std::to_string(std::cos(angle)), s = std::to_string(std::sin(angle));
  return strip({"x", "y", "0"}, {"1 + (x - 2)*" + c, "y", "(x - 2)*" + s}, stiffness);
}

// ---- the propped beam --------------------------------------------------------------------------------------------------

constexpr double span = 2, pressure = 1e-3;  // the first span has length 1

/// A strip clamped at x = 0 and propped at x = 3, with a hinge at x = 1.
problem::Problem propped(double stiffness) {
  problem::Problem p = strip({"x", "y", "0"}, {"1 + 2*(x - 2)", "y", "0"}, stiffness);
  p.shell.supports = {clamped("west"), held("east", {Direction::z})};
  p.shell.loads.on_areas = {force(0, 0, -pressure)};
  p.probes = {{.name = "hinge", .at = {1, 0.5}}};
  return p;
}

/// The hinge of the propped beam of Timoshenko with the moment m, positive if it stretches the lower face.
struct HingeOfBeam {
  explicit HingeOfBeam(double m) : moment(m) {
    const double V = pressure * span / 2 - m / span;  // the shear force
    const double before = -(m - V / 2 - pressure / 6) / bending_stiffness;
    sag = -(m / 2 - V / 3 - pressure / 8) / bending_stiffness + (V + pressure / 2) / shear_stiffness;
    const double after = -sag / span + m / (shear_stiffness * span) +
                         (m * span / 3 + pressure * std::pow(span, 3) / 24) / bending_stiffness;
    angle = before - after;
  }
  /// That of a spring: moment = k angle.
  static HingeOfBeam with_spring(double k) {
    const double at_zero = HingeOfBeam(0).angle, slope = HingeOfBeam(1).angle - at_zero;
    return HingeOfBeam(k * at_zero / (1 - k * slope));
  }
  static HingeOfBeam stiff() {
    const double at_zero = HingeOfBeam(0).angle;
    return HingeOfBeam(-at_zero / (HingeOfBeam(1).angle - at_zero));
  }
  double moment, sag = 0, angle = 0;
};

TEST(Hinges, OfAProppedBeamHaveItsDeflectionAndAngle) {
  for (const double k : {0.0, 0.01, 0.1, 10.0}) {
    const HingeOfBeam exact = HingeOfBeam::with_spring(k);
    const problem::Problem p = propped(k);
    EXPECT_FALSE(examination::has_errors(examination::examine(p)));
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_NEAR(r.probes.at(0).values.u[2], -exact.sag, 1e-7 * std::abs(exact.sag)) << k;
    const double energy = k * exact.angle * exact.angle / 2;
    EXPECT_NEAR(r.summary.energy.foundations, energy, 1e-6 * energy) << k;
    EXPECT_LT(r.certificate.stationarity, 1e-8);
    EXPECT_LT(r.certificate.force_balance, 1e-9);
    EXPECT_LT(r.certificate.moment_balance, 1e-9);
    EXPECT_LT(r.certificate.energy_identity, 1e-9);
  }
}

TEST(Hinges, OfGreatStiffnessTendToThePlainJoinAtFirstOrder) {
  const auto sag = [](const problem::Problem& p) { return solve(p, MPI_COMM_WORLD).probes.at(0).values.u[2]; };
  problem::Problem plain = propped(0);
  plain.joins[0].is_hinge = false;
  const double limit = sag(plain), near = sag(propped(100)) - limit, nearer = sag(propped(1000)) - limit;
  EXPECT_NEAR(limit, -HingeOfBeam::stiff().sag, 1e-7 * std::abs(limit));
  EXPECT_NEAR(near / nearer, 10, 0.1);
}

TEST(Hinges, AreTheSameWithFiniteRotationsThatAreSmall) {
  problem::Problem p = propped(0.1);
  p.shell.loads.on_areas = {force(0, 0, -1e-4 * pressure)};
  const double small = solve(p, MPI_COMM_WORLD).probes.at(0).values.u[2];
  p.shell.rotations = element::Rotations::finite;
  EXPECT_NEAR(solve(p, MPI_COMM_WORLD).probes.at(0).values.u[2] / small, 1, 1e-5);
}

TEST(Hinges, DoNotDependOnRanksAndOnTheSideThatIsNamedFirst) {
  for (const auto rotations : {element::Rotations::small, element::Rotations::finite}) {
    problem::Problem p = folded(0.7, 0.02);
    p.shell.rotations = rotations;
    p.shell.supports = {clamped("west"), held("east", {Direction::x, Direction::y, Direction::z})};
    p.shell.loads.on_areas = {force(1e-2, 3e-3, -2e-2)};
    const double all = solve(p, MPI_COMM_WORLD).summary.energy.total(),
                 one = solve(p, MPI_COMM_SELF).summary.energy.total();
    p.joins[0].boundaries = {"seam_b", "seam_a"};
    const double swapped = solve(p, MPI_COMM_WORLD).summary.energy.total();
    EXPECT_NEAR(all / one, 1, 1e-8);
    EXPECT_NEAR(swapped / one, 1, 1e-8);
  }
}

// ---- folding by a moment -----------------------------------------------------------------------------------------------

/// A frame of two legs of length one under a moment at its tip: both legs bend, and the hinge turns by M / k.
TEST(Hinges, FoldByTheMomentOverTheirStiffness) {
  for (const Formulation formulation : {Formulation::tangent, Formulation::penalised, Formulation::mixed})
    for (const double angle : {0.0, 0.5, 1.5707963, -2.0}) {
      constexpr double moment = 1e-3, bend = moment / bending_stiffness, k = 0.05;
      problem::Problem p = folded(angle, k);
      p.shell.tangency.formulation = formulation;
      p.shell.supports = {clamped("west")};
      const double c = std::cos(angle), s = std::sin(angle);
      p.rigid_bodies = {
          {.name = "tip", .boundaries = {"east"}, .reference = {1 + c, 0.5, s}, .moment = {0, moment, 0}}};
      EXPECT_FALSE(examination::has_errors(examination::examine(p)));
      const Result r = solve(p, MPI_COMM_WORLD);
      ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
      const auto& tip = r.summary.body_reactions.at(0);
      EXPECT_NEAR(tip.rotation[1], 2 * bend + moment / k, 1e-5 * moment / k) << angle;
      const Vector3d expected = Vector3d(0, 0, -bend / 2) + (1.5 * bend + moment / k) * Vector3d(s, 0, -c);
      EXPECT_LT((tip.displacement - expected).norm(), 1e-5 * moment / k) << angle;
      EXPECT_NEAR(r.summary.energy.foundations, moment * moment / k / 2, 1e-5 * moment * moment / k / 2);
      EXPECT_LT(r.certificate.energy_identity, 1e-9);
      EXPECT_LT(r.certificate.moment_balance, 1e-9);
    }
}

/// The moment is the same everywhere in a strip, also with finite rotations: the hinge turns by M / k exactly.
TEST(Hinges, FoldByTheMomentOverTheirStiffnessAtLargeAngles) {
  for (const double fold : {0.0, 1.0})
    for (const double turn : {1.0, -2.0}) {
      constexpr double k = 1e-4;
      const double moment = k * turn, bend = moment / bending_stiffness;
      problem::Problem p = folded(fold, k);
      p.shell.rotations = element::Rotations::finite;
      p.shell.supports = {clamped("west")};
      p.rigid_bodies = {{.name = "tip",
                         .boundaries = {"east"},
                         .reference = {1 + std::cos(fold), 0.5, std::sin(fold)},
                         .moment = {0, moment, 0}}};
      p.steps = {{.name = "fold", .parts = 4}};
      const Result r = solve(p, MPI_COMM_WORLD);
      ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
      EXPECT_NEAR(r.summary.energy.foundations, moment * moment / k / 2, 1e-7 * moment * moment / k) << fold;
      EXPECT_NEAR(r.summary.body_reactions.at(0).rotation[1], turn + 2 * bend, 1e-5) << fold;
    }
}

// With finite rotations a free hinge costs nothing, and both sides turn by themselves.
TEST(Hinges, ThatAreFreeLetAPlateTurnByAnyAngleWithoutStrain) {
  for (const double fold : {0.0, 1.0}) {
    problem::Problem p = folded(fold, 0);
    p.shell.rotations = element::Rotations::finite;
    p.shell.supports = {clamped("west")};
    const std::optional<double> open;
    p.rigid_bodies = {{.name = "tip", .boundaries = {"east"}, .fixed = {open, open, open, 0.0, 1.2, 0.0}}};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_LT(r.summary.energy.total(), 1e-11 * young * thickness) << fold;
    EXPECT_NEAR(r.summary.max_rotation, 1.2, 1e-6);
  }
}

// ---- motions without strain --------------------------------------------------------------------------------------------

int motions_without_strain(const problem::Problem& p) {
  const auto meshes = meshing::mesh_sequence(p, MPI_COMM_WORLD);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, p.charts);
  const auto discrete = assembly::discretise(meshes.space(), surface, p.shell, {});
  int count = 0;
  for (const spectra::Mode& mode : spectra::softest_modes(*discrete, 10, 1)) count += mode.stiffness == 0;
  return count;
}

/// Three sheets at 120 degrees that meet along y.
problem::Problem star(const std::vector<fem::Join>& joins) {
  problem::Problem p = folded(0, 0);
  const std::string c = "(-0.5)", s = "0.86602540378443865";
  p.domain = domain::MeshFile{.path = PLASTRON_TESTS_DIR "/computation/meshes/three-squares.msh"};
  p.charts.clear();
  p.charts.emplace("a", Chart({"x", "y", "0"}, {}));
  p.charts.emplace("b", Chart({"(x - 2)*" + c, "y", "(x - 2)*" + s}, {}));
  p.charts.emplace("c", Chart({"(x - 4)*" + c, "y", "-(x - 4)*" + s}, {}));
  p.joins = joins;
  p.discretisation.degree = 2;
  return p;
}

TEST(Hinges, LeaveOneMotionMoreThanKinksUnlessTheyAreStiff) {
  for (const double angle : {0.0, 1.0}) {
    EXPECT_EQ(motions_without_strain(folded(angle, 0)), 7);
    EXPECT_EQ(motions_without_strain(folded(angle, 1)), 6);
  }
  const auto join = [](const char* one, const char* other, bool is_hinge, double stiffness) {
    return fem::Join{.boundaries = {one, other}, .is_hinge = is_hinge, .stiffness = stiffness};
  };
  EXPECT_EQ(motions_without_strain(star({join("a_west", "b_west", true, 0), join("b_west", "c_west", true, 0)})), 8);
  EXPECT_EQ(motions_without_strain(star({join("a_west", "b_west", true, 0), join("b_west", "c_west", false, 0)})), 7);
  EXPECT_EQ(motions_without_strain(star({join("a_west", "b_west", true, 0), join("b_west", "c_west", true, 1)})), 7);
  EXPECT_EQ(motions_without_strain(star({join("a_west", "b_west", true, 1), join("b_west", "c_west", true, 1)})), 6);
}

/// A kink beside a hinge keeps its angle while both turn, whatever pairs are named.
TEST(Hinges, BesideAKinkTurnItsSheetsTogether) {
  std::vector<double> energies;
  const fem::Join kink{.boundaries = {"b_west", "c_west"}}, hinge{.boundaries = {"a_west", "b_west"}, .is_hinge = true},
      other{.boundaries = {"a_west", "c_west"}, .is_hinge = true};
  for (const auto& joins : {std::vector{hinge, kink}, std::vector{kink, other}, std::vector{hinge, other, kink}}) {
    problem::Problem p = star(joins);
    p.shell.rotations = element::Rotations::finite;
    p.shell.supports = {clamped("a_east"), held("b_east", {Direction::x, Direction::y, Direction::z})};
    p.shell.loads.on_areas = {force(1e-3, 3e-4, -2e-3)};
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    energies.push_back(r.summary.energy.total());
    EXPECT_NEAR(solve(p, MPI_COMM_SELF).summary.energy.total() / energies.back(), 1, 1e-7);
  }
  EXPECT_NEAR(energies[1] / energies[0], 1, 1e-7);
  EXPECT_NEAR(energies[2] / energies[0], 1, 1e-7);
}

// ---- contact -----------------------------------------------------------------------------------------------------------

TEST(Hinges, ArePressedOnATable) {
  for (const double slope : {0.0, 0.5}) {
    problem::Problem p = strip({"x", "y", std::to_string(slope) + "*(1 - x) + 0.03"},
                               {"x - 1", "y", std::to_string(slope) + "*(x - 2) + 0.03"}, 0);
    p.shell.supports = {clamped("west"), clamped("east")};
    p.shell.loads.on_areas = {force(0, 0, -20)};
    p.shell.obstacles.all = {obstacle::Obstacle{}};
    p.discretisation.degree = 2;
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.status, contact::Status::solved) << r.missed_limits;
    EXPECT_GT(r.summary.touching_nodes, 0);
    EXPECT_LT(r.certificate.energy_identity, 1e-9);
    EXPECT_LT(r.certificate.force_balance, 1e-9);
  }
}

/// Cells along a hinge stay alike, and the energy converges.
TEST(Hinges, AreAccurateOnMeshesThatAreGraded) {
  problem::Problem p = propped(0.1);
  p.shell.supports = {clamped("west"), held("east", {Direction::x, Direction::y, Direction::z})};
  p.shell.loads.on_areas = {force(0, 0, -pressure)};
  p.discretisation.degree = 3;
  p.accuracy = problem::Accuracy{.goals = {{"energy", 1e-4}}};
  const Result graded = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(graded.status, contact::Status::solved) << graded.missed_limits;
  const double exact = HingeOfBeam::with_spring(0.1).angle;
  EXPECT_NEAR(graded.summary.energy.foundations / (0.05 * exact * exact), 1, 1e-2);
}

}  // namespace
}  // namespace plastron::computation::hinges_test
