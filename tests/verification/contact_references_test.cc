// The eleven contact problems (M17) with known answers: energy, reaction, contact boundary, convergence, iterations.
#include "verification/figures.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plastron::verification::contact_references_test {
namespace {

constexpr std::int64_t most_unknowns = 60'000;

const auto* const figures = testing::AddGlobalTestEnvironment(new EveryFigureIsHeld("verification_contact"));

struct Computation {
  ContactReference reference;
  computation::Result result;
  double element_size;  ///< in the coordinate of the contact boundaries
};

Computation run(const std::string& name, int degree, int strip_refinements, int disk_refinements) {
  ContactReference reference = contact_reference(name, degree, 0);
  const int refinements = reference.axisymmetric ? disk_refinements : strip_refinements;
  reference.problem.discretisation.refinements = refinements;
  double coarse = 0;
  if (const auto* disk = std::get_if<domain::Disk>(&reference.problem.domain)) coarse = 0.7 * disk->radius;
  if (const auto* strip = std::get_if<domain::Rectangle>(&reference.problem.domain))
    coarse = (strip->to[0] - strip->from[0]) / strip->cells[0];
  computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  return {std::move(reference), std::move(result), coarse / (1 << refinements)};
}

bool should_touch(const ContactReference& reference, double at) {
  const auto zone = std::ranges::count_if(reference.boundaries, [at](double b) { return b < at; });
  return reference.pattern[static_cast<std::size_t>(zone)] == 'C';
}

/// Largest distance from a contact boundary of a node on the wrong side of it.
double worst_misplaced_node(const Computation& r) {
  const auto& discrete = *r.result.solution->discrete;
  double worst = 0;
  for (std::size_t i = 0; i < discrete.points.size(); ++i) {
    const Eigen::Vector2d& x = discrete.points[i].x;
    const double at = r.reference.axisymmetric ? x.norm() : x[0];
    const bool touches = r.result.solution->nodal.touching.local()[i] != 0;
    if (touches == should_touch(r.reference, at)) continue;
    double distance = std::numeric_limits<double>::infinity();
    for (const double b : r.reference.boundaries) distance = std::min(distance, std::abs(at - b));
    worst = std::max(worst, distance);
  }
  return worst;
}

double relative(double computed, double expected) {
  return expected == 0 ? std::abs(computed) : std::abs(computed / expected - 1);
}

/// Compares the unknowns, the signed errors and the worst misplaced node with a row of docs/verification.md.
void expect_figures(const std::string& table, const std::string& row, const Computation& r) {
  const double factor = r.reference.factor;
  expect_figure(table, row, "unknowns", r.result.levels.back().unknowns);
  expect_figure(table, row, "energy", factor * r.result.summary.energy.total() / r.reference.energy - 1);
  if (r.reference.reaction == 0) return;
  expect_figure(table, row, "reaction", factor * r.result.summary.reaction.force[2] / r.reference.reaction - 1);
  expect_figure(table, row, "boundary", worst_misplaced_node(r) / r.element_size);
}

class ContactReferences : public testing::TestWithParam<std::tuple<std::string, int>> {};
INSTANTIATE_TEST_SUITE_P(All, ContactReferences,
                         testing::Combine(testing::ValuesIn(contact_reference_names()), testing::Values(3, 4)),
                         [](const auto& parameters) {
                           std::string name =
                               fmt::format("{}_degree{}", std::get<0>(parameters.param), std::get<1>(parameters.param));
                           std::ranges::replace_if(
                               name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });

TEST_P(ContactReferences, EnergyReactionAndContactBoundaryAreRight) {
  const auto& [name, degree] = GetParam();
  const Computation r = degree == 3 ? run(name, 3, 3, 4) : run(name, 4, 3, 3);
  const computation::Result& result = r.result;
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_LE(result.levels.back().unknowns, most_unknowns);
  const double factor = r.reference.factor;
  EXPECT_LT(relative(factor * result.summary.energy.total(), r.reference.energy), 1e-3);
  EXPECT_LT(relative(factor * result.summary.reaction.force[2], r.reference.reaction), 1e-3);
  EXPECT_LT(relative(factor * result.summary.load_work, r.reference.load_work), 1e-3);
  EXPECT_LE(worst_misplaced_node(r), r.element_size);

  // Converging: errors change sign when the free boundary passes from node to node, so the finest mesh is compared with
  // the worst. The coarsest strips are already right to half a per mille.
  double worst = 0;
  for (const computation::Level& level : result.levels)
    worst = std::max(worst, relative(factor * level.energy, r.reference.energy));
  EXPECT_LT(relative(factor * result.levels.back().energy, r.reference.energy), 0.4 * worst + 1e-9);
  const bool bounded = name.starts_with("R1") || name.starts_with("R4cap");
  for (std::size_t l = 1; l < result.levels.size(); ++l)
    EXPECT_LE(result.levels[l].iterations, bounded ? 6 : 12) << "level " << l;

  // The certificate.
  const certificate::Certificate& c = result.certificate;
  EXPECT_LT(c.stationarity, 1e-9);
  EXPECT_LT(c.energy_identity, 1e-9);
  EXPECT_LT(c.force_balance, 1e-10);
  EXPECT_GE(c.min_pressure, 0);
  EXPECT_GT(c.min_gap_nodes, -1e-12);
  EXPECT_TRUE(std::isfinite(c.min_gap_between));
  expect_figures(fmt::format("contact, degree {}", degree), contact_reference_title(name), r);
}

// Elements of four thicknesses: the reaction is a layer much thinner than an element.
TEST(ThinPlate, OfDegreeTwoHasSingleNodesThatLiftOffBehindTheBoundary) {
  const Computation r = run("R3_e0.01_P0.5", 2, 0, 4);
  ASSERT_EQ(r.result.status, contact::Status::solved);
  expect_figures("contact, degree 2", contact_reference_title(r.reference.name), r);
}

struct TriangleMesh {
  std::string name;
  int degree, refinements;
};

class TriangleContactReferences : public testing::TestWithParam<TriangleMesh> {};
INSTANTIATE_TEST_SUITE_P(All, TriangleContactReferences,
                         testing::Values(TriangleMesh{"R3_e0.01_P0.5", 2, 4}, TriangleMesh{"R4cap_e0.1_p0.02", 2, 4},
                                         TriangleMesh{"R4cap_e0.02_p0.002", 2, 4},
                                         TriangleMesh{"R4hat_e0.05_p0.00125", 2, 4}, TriangleMesh{"R1_e0.1_P3", 2, 4},
                                         TriangleMesh{"R1_e0.01_P3", 2, 4}, TriangleMesh{"R2bowl_e0.02_p0.0008", 2, 4},
                                         TriangleMesh{"R2incl_al0.3_e0.1_p0.02", 2, 4},
                                         TriangleMesh{"R4cap_e0.1_p0.02", 1, 5},
                                         TriangleMesh{"R4cap_e0.02_p0.002", 1, 5}, TriangleMesh{"R3_e0.01_P0.5", 1, 5}),
                         [](const auto& mesh) {
                           std::string name = fmt::format("{}_degree{}", mesh.param.name, mesh.param.degree);
                           std::ranges::replace_if(
                               name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
                           return name;
                         });

TEST_P(TriangleContactReferences, HaveTheEnergyAndTheReactionThatTheirElementsAllow) {
  const auto& [name, degree, refinements] = GetParam();
  ContactReference reference = contact_reference(name, degree, refinements);
  reference.problem.discretisation.cells = mesh::Shape::triangle;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  const std::string table = fmt::format("contact, triangles of degree {}", degree);
  const std::string row = contact_reference_title(name);
  expect_figure(table, row, "unknowns", result.levels.back().unknowns);
  expect_figure(table, row, "energy", reference.factor * result.summary.energy.total() / reference.energy - 1);
  expect_figure(table, row, "reaction", reference.factor * result.summary.reaction.force[2] / reference.reaction - 1);
}

TEST(TriangleContactReference, OfDegreeTwoHasTheEnergyAndTheReactionOfTheCap) {
  ContactReference reference = contact_reference("R4cap_e0.1_p0.02", 2, 4);
  reference.problem.discretisation.cells = mesh::Shape::triangle;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  EXPECT_LE(result.levels.back().unknowns, most_unknowns);
  for (const std::string& warning : result.warnings) EXPECT_NE(warning.find("linear"), std::string::npos) << warning;
  EXPECT_LT(relative(result.summary.energy.total(), reference.energy), 2e-4);
  EXPECT_LT(relative(result.summary.reaction.force[2], reference.reaction), 2e-4);
  EXPECT_LT(result.certificate.min_gap_between, 0);  // measured: there are cells near the table
  EXPECT_LT(-result.certificate.min_gap_between, 1e-4);
  const certificate::Certificate& c = result.certificate;
  EXPECT_LT(c.stationarity, 1e-9);
  EXPECT_LT(c.energy_identity, 1e-9);
  EXPECT_GE(c.min_pressure, 0);
  EXPECT_GT(c.min_gap_nodes, -1e-12);
}

// R1: a clamped strip of length 1 that touches along [b, 1 - b]. Outside the strip is a beam with clamped end and free
// boundary: closed forms of the reference, which the file contains. Here the boundary must converge to it.
TEST(ContactClosedForm, TheContactBoundaryOfAStripConvergesToItsClosedForm) {
  for (const char* name : {"R1_e0.1_P3", "R1_e0.01_P3"}) {
    const Computation coarse = run(name, 2, 2, 0), fine = run(name, 2, 4, 0);
    ASSERT_EQ(coarse.result.status, contact::Status::solved);
    ASSERT_EQ(fine.result.status, contact::Status::solved);
    EXPECT_LE(worst_misplaced_node(coarse), coarse.element_size) << name;
    EXPECT_LE(worst_misplaced_node(fine), fine.element_size) << name;
  }
}

}  // namespace
}  // namespace plastron::verification::contact_references_test
