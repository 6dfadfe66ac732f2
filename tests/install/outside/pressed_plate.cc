// A round plate, clamped at its rim, is pressed on a table 1 cm below it. Prints what the table carries.
#include <plastron/computation/solve.hpp>

#include <mpi.h>

#include <cstdio>

using namespace plastron;

problem::Problem pressed_plate() {
  using assembly::Direction, assembly::Unknown;
  problem::Problem problem;
  problem.domain = domain::Disk{.radius = 0.5};
  problem.charts.emplace("", geometry::Chart({"x", "y", "0.02"}, {}));  // the mid-surface
  problem.shell.sections.common.thickness = geometry::Expression(0.02);
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  assembly::Support clamped{.boundary = "rim", .components = {}};
  for (const auto unknown : {Unknown::displacement, Unknown::rotation})
    for (const auto direction : {Direction::x, Direction::y, Direction::z})
      clamped.components.push_back({unknown, direction, {}});
  problem.shell.supports = {clamped};
  problem.shell.loads.on_areas.emplace_back().force[2] = geometry::Expression(-2e-5);
  problem.shell.obstacles.all = {obstacle::Obstacle{}};  // the plane z = 0 under the lower face
  problem.discretisation = {.degree = 2, .refinements = 2};
  return problem;
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const computation::Result result = computation::solve(pressed_plate(), MPI_COMM_WORLD);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0)
    std::printf("%s, the table carries %.17g N\n", contact::to_string(result.status).data(),
                result.summary.reaction.force[2]);
  return MPI_Finalize();
}
