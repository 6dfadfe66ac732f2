// Shells joined at an angle: folded plates, three sheets at one edge, the corner of a box. Rigid motions cost no energy, all other
// motions do, and the shells bend as frames do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <plastron/computation/solve.hpp>
#include <plastron/examination/examine.hpp>
#include <plastron/meshing/sequence.hpp>
#include <research/spectra/spectra.hpp>

#include <cmath>
#include <numbers>

#include "computation/problems.hpp"

namespace plastron::computation::kinked_joins_test {
namespace {

using namespace test;
using Eigen::Vector3d;
using element::Formulation;

constexpr double young = 1e4, thickness = 0.05, bending_stiffness = young * thickness * thickness * thickness / 12;

/// Unit squares with x = 2k + s, y = t each.
problem::Problem of_squares(const std::string& mesh, const std::map<std::string, std::array<std::string, 3>>& charts) {
  problem::Problem p;
  p.domain = domain::MeshFile{.path = PLASTRON_TESTS_DIR "/computation/meshes/" + mesh};
  for (const auto& [region, chart] : charts) p.charts.emplace(region, Chart(chart, {}));
  p.shell.sections.common.thickness = Expression(thickness);
  p.shell.sections.common.material = shell::Material::from_young_poisson(young, 0, 1);
  p.discretisation = {.degree = 2, .refinements = 0};
  return p;
}

problem::Problem folded(double angle) {
  problem::Problem p = of_squares(
      "two-squares.msh",
      {{"first", {"x", "y", "0"}},
       {"second",
        {"1 + (x - 2)*" + std::to_string(std::cos(angle)), "y", "(x - 2)*" + std::to_string(std::sin(angle))}}});
  p.joins = {{{"seam_a", "seam_b"}}};
  return p;
}

/// Three sheets at 120 degrees that meet along y, with the named joins.
problem::Problem star(const std::vector<fem::Join>& joins) {
  const std::string c = "(-0.5)", s = "0.86602540378443865";
  problem::Problem p = of_squares("three-squares.msh", {{"a", {"x", "y", "0"}},
                                                        {"b", {"(x - 2)*" + c, "y", "(x - 2)*" + s}},
                                                        {"c", {"(x - 4)*" + c, "y", "-(x - 4)*" + s}}});
  p.joins = joins;
  return p;
}

problem::Problem box_corner() {
  problem::Problem p =
      of_squares("three-squares.msh", {{"a", {"x", "y", "0"}}, {"b", {"x - 2", "0", "y"}}, {"c", {"0", "x - 4", "y"}}});
  p.joins = {{{"a_south", "b_south"}}, {{"a_west", "c_south"}}, {{"b_west", "c_west"}}};
  return p;
}

int motions_without_strain(const problem::Problem& p) {
  const auto meshes = meshing::mesh_sequence(p, MPI_COMM_WORLD);
  const auto surface = std::make_shared<const fem::Surface>(meshes.space()->coarse, p.charts);
  const auto discrete = assembly::discretise(meshes.space(), surface, p.shell, {});
  int count = 0;
  for (const spectra::Mode& mode : spectra::softest_modes(*discrete, 8, 1)) count += mode.stiffness == 0;
  return count;
}

TEST(KinkedJoins, LeaveSixMotionsFreeOfStrain) {
  EXPECT_EQ(motions_without_strain(folded(1)), 6);
  EXPECT_EQ(motions_without_strain(folded(-0.1)), 6);
  EXPECT_EQ(motions_without_strain(star({{{"a_west", "b_west"}}, {{"b_west", "c_west"}}})), 6);
  EXPECT_EQ(motions_without_strain(box_corner()), 6);
  problem::Problem triangles = box_corner();
  triangles.discretisation.cells = mesh::Shape::triangle;
  triangles.shell.tying = false;
  EXPECT_EQ(motions_without_strain(triangles), 6);
}

// With finite rotations, too: a body turns the folded plate that it carries without strain.
TEST(KinkedJoins, TurnByAnyAngleWithoutStrain) {
  for (const double turn : {0.3, 1.2})
    for (const double angle : {1.0, -2.0}) {
      problem::Problem p = folded(angle);
      p.rigid_bodies = {{.name = "holder", .boundaries = {"west"}, .fixed = {0.0, 0.0, 0.0, 0.3, turn, 0.0}}};
      p.shell.rotations = element::Rotations::finite;
      const Result r = solve(p, MPI_COMM_WORLD);
      EXPECT_EQ(r.status, contact::Status::solved) << r.missed_limits;
      EXPECT_LT(r.summary.energy.total(), 1e-11 * young * thickness) << turn << " " << angle;
      EXPECT_GT(r.summary.max_rotation, 0.9 * turn);
    }
}

/// A frame of two legs of length one under a moment at its tip. Both legs bend alike, whatever the angle between them.
TEST(KinkedJoins, CarryTheMomentOfAFoldedCantilever) {
  for (const Formulation formulation : {Formulation::tangent, Formulation::penalised, Formulation::mixed})
    for (const double angle : {0.5, 1.5707963, -2.0}) {
      problem::Problem p = folded(angle);
      p.shell.tangency.formulation = formulation;
      p.shell.supports = {clamped("west")};
      const double c = std::stod(std::to_string(std::cos(angle))), s = std::stod(std::to_string(std::sin(angle)));
      constexpr double moment = 1e-3, bend = moment / bending_stiffness;
      p.rigid_bodies = {
          {.name = "tip", .boundaries = {"east"}, .reference = {1 + c, 0.5, s}, .moment = {0, moment, 0}}};
      for (const auto& finding : examination::examine(p))
        EXPECT_NE(finding.severity, examination::Severity::error) << finding.text;
      const Result result = solve(p, MPI_COMM_WORLD);
      ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
      const auto& tip = result.summary.body_reactions.at(0);
      EXPECT_NEAR(tip.rotation[1], 2 * bend, 1e-5 * bend) << angle;  // charts have six digits
      const Vector3d expected = Vector3d(0, 0, -bend / 2) + 1.5 * bend * Vector3d(s, 0, -c);
      EXPECT_LT((tip.displacement - expected).norm(), 1e-5 * bend) << angle;
      EXPECT_LT(result.certificate.stationarity, 1e-9);
      EXPECT_LT(result.certificate.force_balance, 1e-9);
      EXPECT_LT(result.certificate.moment_balance, 1e-9);
      EXPECT_LT(result.certificate.energy_identity, 1e-9);
    }
}

// The sheet that is named first decides the displacement of the seam; the number of ranks, too, may change the sheet that decides.
TEST(KinkedJoins, BuckleAlikeWhicheverSheetDecides) {
  using Texts = std::array<std::string, 3>;
  const auto one = [](const std::string& s, const std::string& t) { return Texts{s, t, "0.05*sin(3*(" + s + "))"}; };
  const auto other = [](const std::string& s, const std::string& t) {
    return Texts{"1 + 0.5*(" + s + ")", t, "0.05*sin(3) + 0.6*(" + s + ") + 0.04*sin(4*(" + s + "))"};
  };
  std::vector<double> factors;
  for (const bool is_swapped : {false, true}) {
    problem::Problem p =
        is_swapped
            ? of_squares("two-squares.msh", {{"first", other("1 - x", "1 - y")}, {"second", one("3 - x", "1 - y")}})
            : of_squares("two-squares.msh", {{"first", one("x", "y")}, {"second", other("x - 2", "y")}});
    p.joins = {{{"seam_a", "seam_b"}}};
    p.shell.supports = {clamped(is_swapped ? "east" : "west")};
    p.shell.loads.on_areas = {{.force = vector(-0.01, 0, -0.02)}};
    p.modes.buckling = 2;
    const Result r = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(r.modes.size(), 2U);
    for (const Mode& mode : r.solution->modes) factors.push_back(mode.value);
  }
  EXPECT_NEAR(factors[0] / factors[2], 1, 1e-9);
  EXPECT_NEAR(factors[1] / factors[3], 1, 1e-9);
}

/// Three clamped sheets that meet. The result depends neither on the named pairs nor on the ranks.
TEST(KinkedJoins, OfThreeSheetsAreOneWhateverPairsAreNamed) {
  const auto energy = [](const std::vector<fem::Join>& joins, MPI_Comm comm) {
    problem::Problem p = star(joins);
    p.shell.supports = {clamped("a_east"), clamped("b_east")};
    p.shell.loads.on_areas = {force(1e-3, 3e-4, -2e-3)};
    const Result result = solve(p, comm);
    EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    EXPECT_LT(result.certificate.moment_balance, 1e-9);
    EXPECT_LT(result.certificate.energy_identity, 1e-9);
    return result.summary.energy.total();
  };
  const std::vector<fem::Join> chain{{{"a_west", "b_west"}}, {{"b_west", "c_west"}}};
  const double of_chain = energy(chain, MPI_COMM_WORLD);
  EXPECT_NEAR(energy(chain, MPI_COMM_SELF), of_chain, 1e-12 * of_chain);
  EXPECT_NEAR(energy({{{"a_west", "c_west"}}, {{"a_west", "b_west"}}}, MPI_COMM_WORLD), of_chain, 1e-10 * of_chain);
  EXPECT_NEAR(energy({{{"a_west", "c_west"}}, {{"c_west", "b_west"}}, {{"a_west", "b_west"}}}, MPI_COMM_WORLD),
              of_chain, 1e-10 * of_chain);
}

/// A support of the second sheet's node equals a support of the joint.
TEST(KinkedJoins, AreHeldThroughEitherSheet) {
  const auto energy = [](const std::string& seam) {
    problem::Problem p = folded(1);
    p.shell.supports = {clamped(seam)};
    p.shell.loads.on_areas = {force(1e-4, 2e-4, -1e-3)};
    const Result result = solve(p, MPI_COMM_WORLD);
    EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    EXPECT_LT(result.certificate.moment_balance, 1e-9);
    return result.summary.energy.total();
  };
  problem::Problem both = folded(1);
  both.shell.supports = {clamped("seam_a"), clamped("seam_b")};
  both.shell.loads.on_areas = {force(1e-4, 2e-4, -1e-3)};
  const double of_both = solve(both, MPI_COMM_WORLD).summary.energy.total(), a = energy("seam_a"), b = energy("seam_b");
  EXPECT_GE(a, of_both * (1 - 1e-12));
  EXPECT_GE(b, of_both * (1 - 1e-12));
  EXPECT_NEAR(a, of_both, 0.05 * of_both);  // only the twist about the conormal of the other sheet is free
  EXPECT_NEAR(b, of_both, 0.05 * of_both);
}

TEST(KinkedJoins, PressTheirEdgeOnATable) {
  problem::Problem p = folded(-1);
  p.shell.supports = {clamped("west"), clamped("east")};
  p.charts.clear();
  p.charts.emplace("first", Chart({"x", "y", "0.03 + 0.5*(1 - x)"}, {}));
  p.charts.emplace("second", Chart({"x - 1", "y", "0.03 + 0.5*(x - 2)"}, {}));
  p.shell.loads.on_areas = {force(0, 0, -20)};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  const Result here = solve(p, MPI_COMM_SELF), all = solve(p, MPI_COMM_WORLD);
  ASSERT_EQ(all.status, contact::Status::solved) << all.missed_limits;
  EXPECT_GT(all.summary.touching_nodes, 0);
  EXPECT_GT(all.summary.reaction.force[2], 0);
  EXPECT_LT(all.certificate.energy_identity, 1e-9);
  EXPECT_LT(all.certificate.force_balance, 1e-9);
  EXPECT_NEAR(all.summary.energy.total(), here.summary.energy.total(), 1e-12 * here.summary.energy.total());
}

/// A ball below the lower edge of two sheets: their sides share each force on the edge, which has one normal.
TEST(KinkedJoins, PressTheirEdgeOnABall) {
  for (const auto& [place, slope] : {std::pair{0.5, 1.0}, std::pair{0.25, 0.5}, std::pair{0.75, 0.3}}) {
    problem::Problem p = folded(-1);
    p.shell.supports = {clamped("west"), clamped("east")};
    p.charts.clear();
    p.charts.emplace("first", Chart({"x", "y", std::to_string(slope) + "*(1 - x)"}, {}));
    p.charts.emplace("second", Chart({"x - 1", "y", "0.3*(x - 2)"}, {}));
    p.discretisation.refinements = 1;
    p.shell.loads.on_areas = {force(0, 0, -2)};
    p.shell.obstacles.all = {{.shape = obstacle::Ball{.centre = {1, place, -0.325}, .radius = 0.3}}};
    const Result result = solve(p, MPI_COMM_WORLD);
    ASSERT_EQ(result.status, contact::Status::solved) << result.missed_limits;
    Vector3d force_of_zones = Vector3d::Zero(), moment = Vector3d::Zero();
    for (const auto& zone : result.summary.obstacles.at(0).zones) {
      force_of_zones += zone.reaction.force;
      moment += zone.reaction.moment;
    }
    const auto& reaction = result.summary.obstacles[0].reaction;
    EXPECT_GT(reaction.force[2], 0.01);
    EXPECT_LT((force_of_zones - reaction.force).norm(), 1e-12 * reaction.force.norm()) << place;
    EXPECT_LT((moment - reaction.moment).norm(), 1e-12 * reaction.force.norm()) << place;
  }
}

TEST(KinkedJoins, OfOppositeNormalsAreRefused) {
  problem::Problem p = folded(0);
  p.charts.clear();
  p.charts.emplace("first", Chart({"1", "y", "x"}, {}));
  p.charts.emplace("second", Chart({"1", "y", "3 - x"}, {}));  // the seam is at z = 1 on both, and each goes down
  try {
    solve(p, MPI_COMM_WORLD);
    FAIL();
  } catch (const mesh::DomainError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("points to opposite sides"));
  }
}

}  // namespace
}  // namespace plastron::computation::kinked_joins_test
