#include <plastron/problem/goal_names.hpp>

#include <algorithm>
#include <string_view>

namespace plastron::problem {

namespace {

estimation::Catalogue catalogue_of(const Problem& problem) {
  estimation::Catalogue catalogue{.axis = problem.output.axis, .is_smooth = problem.output.smooth};
  for (const Probe& probe : problem.probes) catalogue.probes.push_back({probe.name, probe.at});
  for (const assembly::Support& support : problem.shell.supports)
    if (!support.point && std::ranges::count(catalogue.supports, support.boundary) == 0)
      catalogue.supports.push_back(support.boundary);
  for (const obstacle::Obstacle& obstacle : problem.shell.obstacles.all)
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
  const auto add = [&](const std::string& name, double tolerance) {
    goals.push_back(find_goal(name, catalogue).value());
    goals.back().tolerance = tolerance;
  };
  for (const Accuracy::Goal& goal : problem.accuracy->goals) add(goal.name, goal.tolerance);
  const auto is_asked_for = [&](const std::string& name) {
    return std::ranges::find(goals, name, &estimation::Goal::name) != goals.end();
  };
  constexpr std::string_view sum = "reaction";
  if (problem.shell.obstacles.all.size() < 2) return goals;
  for (const Accuracy::Goal& goal : problem.accuracy->goals) {
    if (!goal.name.starts_with(sum)) continue;
    for (const obstacle::Obstacle& obstacle : problem.shell.obstacles.all) {
      const std::string own = "obstacle." + obstacle.name + ".force" + goal.name.substr(sum.size());
      if (!is_asked_for(own)) add(own, goal.tolerance);
    }
  }
  return goals;
}

}  // namespace plastron::problem
