// Reads [[step]] and [[step.move]].
#include <plastron/config/nearest.hpp>
#include <plastron/config/obstacle_shapes.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

/// Largest number of instants in total: each needs a solution and a file.
constexpr int most_parts = 5000;

std::string read_step_name(Table& table, const problem::Problem& problem) {
  std::string name = fmt::format("step-{}", problem.steps.size() + 1);
  if (table.has("name")) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty()) table.report("name", "a step's name is empty", "", "leave the key out or give a name");
  if (std::ranges::count(problem.steps, name, &problem::Step::name) > 0)
    table.report("name", fmt::format("two steps are named \"{}\"", name), "", "choose another name");
  return name;
}

std::vector<std::string> obstacle_names(const Table& root) {
  std::vector<std::string> names;
  for (const auto& obstacle : root.effective["obstacle"]) names.push_back(obstacle["name"]);
  return names;
}

/// Returns the places of the obstacle that the table moves; empty if there is a mistake.
std::vector<std::size_t> moved_obstacles(Table& table, const problem::Problem& problem,
                                         const std::vector<std::string>& known, std::vector<std::string>& seen) {
  const auto name = table.text("obstacle");
  if (!name) return {};
  auto found = obstacles_named(problem, *name);
  if (found.empty())
    table.report("obstacle", fmt::format("there is no obstacle \"{}\"", *name), joined(known),
                 did_you_mean(*name, known));
  if (std::ranges::count(seen, *name) > 0) {
    table.report("obstacle", fmt::format("the step moves the obstacle \"{}\" twice", *name), "",
                 "write all of its motion in one [[step.move]]");
    return {};
  }
  seen.push_back(*name);
  return found;
}

void read_force(Table& table, const problem::Problem& problem, std::size_t k, problem::Step& step) {
  if (!table.has("force")) return;
  const auto factor = table.number("force");
  if (!problem.shell.obstacles.all[k].is_pressed())
    table.report("force", fmt::format("no force presses the obstacle \"{}\"", problem.shell.obstacles.all[k].name), "",
                 "give the obstacle a force");
  if (factor) step.force_factors[k] = *factor;
}

void read_moves(Table& table, const std::vector<std::string>& known, problem::Problem& problem, problem::Step& step) {
  for (obstacle::Obstacle& o : problem.shell.obstacles.all) o.motions.emplace_back();
  auto& effective = table.effective["move"] = nlohmann::json::array();
  std::vector<std::string> seen;
  for (Table& move : table.tables("move")) {
    const auto motion = read_motion(move);
    for (const std::size_t k : moved_obstacles(move, problem, known, seen)) {
      if (motion) problem.shell.obstacles.all[k].motions.back() = *motion;
      read_force(move, problem, k, step);
    }
    effective.push_back(move.effective);
  }
}

}  // namespace

void read_steps(Table& root, problem::Problem& problem) {
  auto& effective = root.effective["step"] = nlohmann::json::array();
  problem::Step step{.force_factors = std::vector<double>(problem.shell.obstacles.all.size(), 1)};
  int parts = 0;
  for (Table& table : root.tables("step")) {
    step.name = read_step_name(table, problem);
    if (table.has("loads")) step.load_factor = table.number("loads").value_or(1);
    table.effective["loads"] = step.load_factor;
    step.parts = table.integer("parts").value_or(1);
    if (step.parts > 0 && (parts += step.parts) > most_parts)
      table.report("parts", fmt::format("the steps have more than {} parts in all", most_parts));
    read_moves(table, obstacle_names(root), problem, step);
    problem.steps.push_back(step);
    effective.push_back(table.effective);
  }
}

}  // namespace plastron::config
