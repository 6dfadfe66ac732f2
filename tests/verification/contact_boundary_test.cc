// The boundaries of contact zones against the reference problems: the free boundary lies between nodes, and is found there to a
// fraction of their distance.
#include "verification/reference_problems.hpp"

#include <plastron/computation/solve.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "larger.hpp"

namespace plastron::verification {
namespace {

struct Mesh {
  std::string name;
  fem::Shape shape;
  int degree, strip_refinements, disk_refinements;
};
void PrintTo(const Mesh& mesh, std::ostream* out) { *out << mesh.name; }

/// Distances of the points of the lines inside the shell from the boundaries of the reference, over the distance of nodes.
struct BoundaryError {
  double largest = 0, mean = 0;
};

/// Length of a cell's side on the coarsest mesh, in the coordinate of the boundaries.
double coarse_size(const fem::Domain& domain) {
  if (const auto* disk = std::get_if<fem::Disk>(&domain)) return 0.7 * disk->radius;
  const auto& strip = std::get<fem::Rectangle>(domain);
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
                         testing::Values(Mesh{"quadrilaterals_2", fem::Shape::quadrilateral, 2, 3, 4},
                                         Mesh{"quadrilaterals_3", fem::Shape::quadrilateral, 3, 2, 3},
                                         Mesh{"triangles_2", fem::Shape::triangle, 2, 3, 3}),
                         [](const auto& mesh) { return mesh.param.name; });

// Half way between the last touching and the first free node would be a quarter of their distance off in the mean, and a half at worst
// where the active set is right.
TEST_P(ContactBoundary, LiesWithinHalfTheDistanceOfNodesFromTheReference) {
  double sum = 0;
  int count = 0;
  for (const std::string& name : contact_reference_names()) {
    // Nothing touches; single nodes lift off behind the boundary of the thin plate (verification_contact, ThinPlate).
    if (name == "R1_e0.1_P0.2" || name == "R3_e0.01_P0.5") continue;
    const BoundaryError error = boundary_error(name, GetParam());
    EXPECT_LT(error.largest, 0.5) << name;
    sum += error.mean;
    ++count;
  }
  EXPECT_LT(sum / count, 0.16);
}

}  // namespace
}  // namespace plastron::verification
