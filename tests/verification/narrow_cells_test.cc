// Narrow cells where a strip bends strongly: Newton steps whose stiffness is not the derivative of the residual repeat themselves and
// lead away from the equilibrium, unless their sum is taken.
#include <plastron/computation/solve.hpp>
#include <plastron/config/case.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace plastron::narrow_cells {
namespace {

/// Writes a row of cells over a strip of width 10 with sides at these places.
void write_row(const std::string& path, const std::vector<double>& sides) {
  std::ofstream file(path);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"left\"\n1 2 \"right\"\n$EndPhysicalNames\n"
       << fmt::format("$Nodes\n{}\n", 2 * sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
    file << fmt::format("{} {} 0 0\n{} {} 10 0\n", 2 * i + 1, sides[i], 2 * i + 2, sides[i]);
  file << fmt::format("$EndNodes\n$Elements\n{}\n1 1 2 1 1 1 2\n2 1 2 2 2 {} {}\n", sides.size() + 1,
                      2 * sides.size() - 1, 2 * sides.size());
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
    file << fmt::format("{} 3 2 0 0 {} {} {} {}\n", i + 3, 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
  file << "$EndElements\n";
}

TEST(AStripWithNarrowCells, ComesToRestInTheEquilibriumOfEqualCells) {
  // 24 equal cells of degree 4 have this energy [mJ]; the strip touches the wall along two lines.
  constexpr double energy = 194.19285;
  const std::string mesh = testing::TempDir() + "narrow-cells.msh";
  write_row(mesh, {0,  16.5, 18.6, 18.72, 19,    19.08, 19.4,  20.2, 25,   35, 50,
                   65, 75,   79.8, 80.6,  80.92, 81,    81.28, 81.4, 83.5, 100});
  const auto text = fmt::format(R"case([units]
length = "mm"
force = "N"
[shell]
E = 70000
nu = 0
thickness = 0.5
rotations = "finite"
[geometry]
domain = {{ mesh = "{}" }}
chart = ["x", "y", 0]
[mesh]
degree = 4
refinements = 0
[[imperfection]]
normal = "0.02*sin(pi*x/100)"
[[support]]
boundary = "left"
fix = ["u"]
[[support]]
boundary = "right"
fix = ["u"]
values = {{ u.x = -3 }}
[[obstacle]]
half_space = {{ point = [0, 0, 4.25], normal = [0, 0, -1] }}
[[step]]
parts = 10
)case",
                                mesh);
  const auto result = computation::solve(config::parse_case(text, "strip.toml").problem, MPI_COMM_WORLD);
  EXPECT_EQ(result.status, contact::Status::solved) << result.missed_limits;
  EXPECT_NEAR(result.summary.energy.total() / energy, 1, 1e-4);
  for (const auto& instant : result.history)
    EXPECT_EQ(instant.status, contact::Status::solved) << "time " << instant.factors.time;
}

}  // namespace
}  // namespace plastron::narrow_cells
