// [[obstacle]] and [[probe]].
#include <plastron/config/obstacle_shapes.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

/// Where the shape stands: `rotate`, then `translate`.
std::optional<obstacle::Placement> read_placement(Table& table) {
  const auto shift = table.vector("translate");
  if (!table.has("rotate"))
    return shift ? std::optional(obstacle::placed({0, 0, 1}, 0, {0, 0, 0}, *shift)) : std::nullopt;
  auto rotate = table.table("rotate");
  if (!rotate) return {};
  const auto axis = read_direction(*rotate, "axis"), about = rotate->vector("about");
  const auto angle = rotate->number("angle");
  table.effective["rotate"] = rotate->effective;
  if (!shift || !axis || !about || !angle) return {};
  return obstacle::placed(*axis, *angle, *about, *shift);
}

/// "obstacle-1", "obstacle-2", ... where the case gives none.
std::string read_obstacle_name(Table& table, const computation::Problem& problem) {
  std::string name = fmt::format("obstacle-{}", problem.obstacles.size() + 1);
  if (table.has("name")) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty()) table.report("name", "an obstacle's name is empty", "", "leave the key out or give a name");
  if (std::ranges::count(problem.obstacles, name, &obstacle::Obstacle::name) > 0)
    table.report("name", fmt::format("two obstacles are named \"{}\"", name), "", "choose another name");
  return name;
}

}  // namespace

void read_obstacles(Table& root, computation::Problem& problem) {
  auto& effective = root.effective["obstacle"] = nlohmann::json::array();
  for (Table& table : root.tables("obstacle")) {
    obstacle::Obstacle result{.name = read_obstacle_name(table, problem)};
    if (auto shape = read_shape(table)) result.shape = std::move(*shape);
    result.placement = read_placement(table).value_or(obstacle::Placement{});
    if (table.text("face") == "upper") result.face = obstacle::Face::upper;
    problem.obstacles.push_back(std::move(result));
    effective.push_back(table.effective);
  }
}

void read_probes(Table& root, const std::optional<fem::Domain>& domain, computation::Problem& problem) {
  auto& effective = root.effective["probe"] = nlohmann::json::array();
  for (Table& table : root.tables("probe")) {
    const auto name = table.text("name");
    const auto at = table.point("at");
    if (name && name->empty()) table.report("name", "a probe needs a name");
    if (name && std::ranges::count(problem.probes, *name, &computation::Probe::name) > 0)
      table.report("name", fmt::format("two probes are named \"{}\"", *name), "", "choose another name");
    if (at && domain && !may_contain(*domain, *at))
      table.report("at", fmt::format("the probe at [{}, {}] is outside the domain", (*at)[0], (*at)[1]));
    problem.probes.push_back({name.value_or(""), at.value_or(Eigen::Vector2d::Zero())});
    effective.push_back(table.effective);
  }
}

}  // namespace plastron::config
