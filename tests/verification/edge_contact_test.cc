// A shell that stands on an edge touches with both faces, each with its own bound: the case has the numbers of face = "both".
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>
#include <plastron/problem/edge_contact.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace plastron::edge_contact {
namespace {

/// A panel that stands on a floor. Its upper end is held across, and `load` [N/m] presses there.
struct Panel {
  std::string rotations = "finite", face = "auto", cells = "[2, 2]", obstacle = "half_space = {}";
  double size = 1, load = 1e-6, base = 0;
};

problem::Problem read(const Panel& panel) {
  problem::Problem problem = config::parse_case(fmt::format(R"case([constants]
s = {0}
[shell]
E = 1
nu = 0.3
thickness = "0.02*s"
rotations = "{1}"
[geometry]
domain = {{ rectangle = {{ from = [0, 0], to = ["s", "0.3*s"], cells = {2} }} }}
chart = ["0.01*y", "x", "y + {3}*s"]
[mesh]
degree = 3
refinements = 0
[[support]]
boundary = "top"
fix = ["u.x", "u.y"]
[[load]]
boundary = "top"
force = [0, 0, "-{4}*s"]
[[obstacle]]
name = "floor"
{5}
face = "{6}"
)case",
                                                            panel.size, panel.rotations, panel.cells, panel.base,
                                                            panel.load, panel.obstacle, panel.face),
                                                "edge.toml")
                                 .problem;
  problem::let_both_faces_touch(problem);
  return problem;
}

TEST(AShellThatStandsOnAnEdge, TouchesWithBothFaces) {
  for (const char* rotations : {"small", "finite"})
    for (const double load : {1e-7, 1e-6, 1e-5})
      for (const double size : {1.0, 1e-6, 1e6}) {
        SCOPED_TRACE(fmt::format("{} rotations, load {:g}, size {:g}", rotations, load, size));
        const Panel panel{.rotations = rotations, .size = size, .load = load};
        Panel both = panel;
        both.face = "both";
        const auto found = computation::solve(read(panel), MPI_COMM_WORLD),
                   expected = computation::solve(read(both), MPI_COMM_WORLD);
        ASSERT_EQ(found.status, contact::Status::solved) << found.missed_limits;
        ASSERT_EQ(found.summary.obstacles.size(), 2U);
        EXPECT_NEAR(found.summary.energy.total() / expected.summary.energy.total(), 1, 1e-9);
        EXPECT_NEAR(found.summary.reaction.force[2] / (load * size * size), 1, 1e-9);
      }
}

TEST(AnObstacleAwayFromAllEdges, IsTouchedByTheNearerFace) {
  Panel panel;
  panel.obstacle = "ball = { centre = [1, 0.5, 0.15], radius = 0.98 }";
  EXPECT_EQ(read(panel).shell.obstacles.all.size(), 1U);
  panel.obstacle = "half_space = { point = [0.02, 0, 0], normal = [-1, 0, 0] }";
  EXPECT_EQ(read(panel).shell.obstacles.all.size(), 1U);
}

}  // namespace
}  // namespace plastron::edge_contact
