#include <plastron/computation/description.hpp>

#include <plastron/computation/gap.hpp>

namespace plastron::computation {

assembly::ShellDescription shell_description(const Problem& problem) {
  return {.thickness = problem.thickness,
          .material = problem.material,
          .tying = problem.discretisation.tying,
          .tangency = problem.discretisation.tangency,
          .supports = problem.supports,
          .area_loads = problem.area_loads,
          .edge_loads = problem.edge_loads,
          .obstacles = rigid_obstacles(problem)};
}

fem::MeshSequence mesh_sequence(const Problem& problem, MPI_Comm comm) {
  return {fem::coarse_mesh(problem.domain, problem.discretisation.cells), problem.discretisation.degree, comm};
}

}  // namespace plastron::computation
