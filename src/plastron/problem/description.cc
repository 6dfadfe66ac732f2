#include <plastron/problem/description.hpp>

#include <plastron/problem/gap.hpp>

namespace plastron::problem {

assembly::ShellDescription shell_description(const Problem& problem) {
  return {.sections = problem.sections,
          .tying = problem.discretisation.tying,
          .tangency = problem.discretisation.tangency,
          .supports = problem.supports,
          .area_loads = problem.area_loads,
          .edge_loads = problem.edge_loads,
          .gravity = problem.gravity,
          .obstacles = rigid_obstacles(problem)};
}

}  // namespace plastron::problem
