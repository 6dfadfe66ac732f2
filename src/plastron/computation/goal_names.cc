#include <plastron/computation/goal_names.hpp>

#include <algorithm>

namespace plastron::computation {

namespace {

estimation::Catalogue catalogue_of(const Problem& problem) {
  estimation::Catalogue catalogue{.axis = problem.output.axis};
  for (const Probe& probe : problem.probes) catalogue.probes.push_back({probe.name, probe.at});
  for (const assembly::Support& support : problem.supports)
    if (!support.point && std::ranges::count(catalogue.supports, support.boundary) == 0)
      catalogue.supports.push_back(support.boundary);
  for (const obstacle::Obstacle& obstacle : problem.obstacles)
    catalogue.obstacles.push_back({obstacle.name, obstacle.is_pressed()});
  return catalogue;
}

}  // namespace

std::vector<std::string> goal_names(const Problem& problem) {
  std::vector<std::string> names;
  for (const estimation::Goal& goal : all_goals(catalogue_of(problem))) names.push_back(goal.name);
  return names;
}

std::vector<estimation::Goal> estimated_goals(const Problem& problem) {
  const estimation::Catalogue catalogue = catalogue_of(problem);
  std::vector<estimation::Goal> goals;
  for (const Accuracy::Goal& goal : problem.accuracy->goals) {
    goals.push_back(find_goal(goal.name, catalogue).value());
    goals.back().tolerance = goal.tolerance;
  }
  return goals;
}

}  // namespace plastron::computation
