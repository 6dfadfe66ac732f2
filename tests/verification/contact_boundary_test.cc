// The boundaries of contact zones against the reference problems. The free boundary lies between nodes and is found there to a
// fraction of their distance.
#include "verification/figures.hpp"
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "larger.hpp"

namespace plastron::verification::contact_boundary_test {
namespace {

struct Mesh {
  std::string name;
  mesh::Shape shape;
  int degree, strip_refinements, disk_refinements;
};
void PrintTo(const Mesh& mesh, std::ostream* out) { *out << mesh.name; }

/// Distances of the points of the lines inside the shell from the boundaries of the reference, over the node distance.
struct BoundaryError {
  double largest = 0, mean = 0;
};

/// Length of a cell's side on the coarsest mesh, in the coordinate of the boundaries.
double coarse_size(const domain::Domain& domain) {
  if (const auto* disk = std::get_if<domain::Disk>(&domain)) return 0.7 * disk->radius;
  const auto& strip = std::get<domain::Rectangle>(domain);
  return (strip.to[0] - strip.from[0]) / strip.cells[0];
}

BoundaryError boundary_error(const std::string& name, const Mesh& mesh) {
  ContactReference reference = contact_reference(name, mesh.degree, 0);
  auto& discretisation = reference.problem.discretisation;
  discretisation.refinements = reference.axisymmetric ? mesh.disk_refinements : mesh.strip_refinements;
  discretisation.cells = mesh.shape;
  const double node_distance = coarse_size(reference.problem.domain) / (1 << discretisation.refinements) / mesh.degree;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved);
  BoundaryError error;
  int points = 0;
  for (const auto& zone : result.summary.obstacles.front().zones)
    for (const auto& line : zone.lines) {
      if (line.is_rim) continue;
      for (const auto& point : line.points) {
        const double at = reference.axisymmetric ? point.x.norm() : point.x[0];
        double distance = std::numeric_limits<double>::infinity();
        for (const double b : reference.boundaries) distance = std::min(distance, std::abs(at - b) / node_distance);
        error.largest = test::larger(error.largest, distance);
        error.mean += distance;
        ++points;
      }
    }
  EXPECT_GT(points, 0);
  error.mean /= points;
  return error;
}

class ContactBoundary : public testing::TestWithParam<Mesh> {};
INSTANTIATE_TEST_SUITE_P(All, ContactBoundary,
                         testing::Values(Mesh{"quadrilaterals_2", mesh::Shape::quadrilateral, 2, 3, 4},
                                         Mesh{"quadrilaterals_3", mesh::Shape::quadrilateral, 3, 2, 3},
                                         Mesh{"triangles_2", mesh::Shape::triangle, 2, 3, 3}),
                         [](const auto& mesh) { return mesh.param.name; });

// Halfway between the last touching and the first free node, the error would be a quarter of the node distance in the mean, and at most a half
// if the active set is right.
TEST_P(ContactBoundary, LiesWithinAThirdOfTheDistanceOfNodesFromTheReference) {
  double sum = 0;
  int count = 0;
  for (const std::string& name : contact_reference_names()) {
    // No contact: groups of nodes lift off behind the boundary of the thin plate (verification_contact, ThinPlate).
    if (name == "R1_e0.1_P0.2" || name == "R3_e0.01_P0.5") continue;
    const BoundaryError error = boundary_error(name, GetParam());
    EXPECT_LT(error.largest, 1.0 / 3) << name;
    sum += error.mean;
    ++count;
  }
  EXPECT_LT(sum / count, 0.1);
}

// ---- the edge for a requested accuracy of the energy ---------------------------------------------------------------------

const auto* const figures = testing::AddGlobalTestEnvironment(new EveryFigureIsHeld("verification_contact_boundary"));

/// Solved like a case without [mesh] whose [accuracy] requests the energy to 1e-4.
ContactReference to_energy(const std::string& name) {
  ContactReference reference = contact_reference(name, 4, 0);
  reference.problem.discretisation.layers = problem::Layers::automatic;
  reference.problem.accuracy = problem::Accuracy{.goals = {{"energy", 1e-4}}};
  return reference;
}

/// For a line along an edge: the mean along it of the coordinate that the references give, and its range.
struct FoundEdge {
  double length = 0, mean = 0, least = 0, most = 0;
};

FoundEdge found_edge(const solution::ContactLine& line, bool axisymmetric) {
  const auto at = [&](const solution::BoundaryPoint& p) { return axisymmetric ? p.x.norm() : p.x[0]; };
  FoundEdge edge{.least = std::numeric_limits<double>::infinity()};
  for (const auto& point : line.points) {
    edge.least = std::min(edge.least, at(point));
    edge.most = std::max(edge.most, at(point));
  }
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Eigen::Vector2d &p = line.points[i - 1].x, &q = line.points[i].x;
    const double part =
        axisymmetric ? std::abs(std::atan2(p[0] * q[1] - p[1] * q[0], p.dot(q))) : std::abs(q[1] - p[1]);
    edge.length += part;
    edge.mean += part * (at(line.points[i - 1]) + at(line.points[i])) / 2;
  }
  edge.mean /= edge.length;
  return edge;
}

/// The longest of all lines that are nearer to this boundary of the reference than to its others. Single nodes that lift off have short lines.
FoundEdge nearest_edge(const computation::Result& result, const ContactReference& reference, double boundary) {
  FoundEdge longest;
  for (const auto& zone : result.summary.obstacles.front().zones)
    for (const auto& line : zone.lines) {
      if (line.is_rim) continue;
      const FoundEdge edge = found_edge(line, reference.axisymmetric);
      const auto nearest =
          std::ranges::min_element(reference.boundaries, {}, [&](double b) { return std::abs(b - edge.mean); });
      if (*nearest == boundary && edge.length > longest.length) longest = edge;
    }
  EXPECT_GT(longest.length, 0);
  return longest;
}

/// For a disk or half a strip the distance from its axis; for a whole strip half the width of its zone.
double radius_of(const ContactReference& reference, double boundary) {
  if (reference.axisymmetric || reference.boundaries.size() == 1) return boundary;
  return (reference.boundaries[1] - reference.boundaries[0]) / 2;
}

class EdgeAtAnEnergy : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, EdgeAtAnEnergy, testing::ValuesIn(contact_reference_names()), [](const auto& name) {
  std::string text = name.param;
  std::ranges::replace_if(
      text, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return text;
});

// The accuracy of the edge when the energy is requested to 1e-4, as most users do.
TEST_P(EdgeAtAnEnergy, IsWhereTheReferenceHasItToTheFiguresOfThePage) {
  const ContactReference reference = to_energy(GetParam());
  if (reference.boundaries.empty()) return;
  const computation::Result result = computation::solve(reference.problem, MPI_COMM_WORLD);
  ASSERT_EQ(result.status, contact::Status::solved);
  Figures mean = Figures::array(), farthest = Figures::array();
  for (const double boundary : reference.boundaries) {
    const FoundEdge edge = nearest_edge(result, reference, boundary);
    const double radius = radius_of(reference, boundary);
    mean.push_back((edge.mean - boundary) / radius);
    farthest.push_back(std::max(edge.most - boundary, boundary - edge.least) / radius);
  }
  const std::string table = "contact edge, energy to 1e-4", row = contact_reference_title(GetParam());
  expect_figure(table, row, "energy", reference.factor * result.summary.energy.total() / reference.energy - 1);
  expect_figure(table, row, "edge", mean);
  expect_figure(table, row, "farthest point", farthest);
  expect_figure(table, row, "area", result.summary.contact_area / contact_area(reference) - 1);
}

}  // namespace
}  // namespace plastron::verification::contact_boundary_test
