// Reads [[obstacle]].
#include <plastron/config/obstacle_shapes.hpp>
#include <plastron/config/sections.hpp>

#include <algorithm>

namespace plastron::config {

namespace {

// An obstacle that both faces may touch is two obstacles.
constexpr const char *of_lower_face = ", lower face", *of_upper_face = ", upper face";

}  // namespace

std::vector<std::size_t> obstacles_named(const problem::Problem& problem, const std::string& name) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < problem.shell.obstacles.all.size(); ++k) {
    const std::string& its = problem.shell.obstacles.all[k].name;
    if (its == name || its == name + of_lower_face || its == name + of_upper_face) found.push_back(k);
  }
  return found;
}

namespace {

/// Returns the given name, otherwise "obstacle-1", "obstacle-2", ... by the obstacle's place.
std::string read_obstacle_name(Table& table, const problem::Problem& problem, std::size_t place) {
  std::string name = fmt::format("obstacle-{}", place);
  const bool is_given = table.has("name");
  if (is_given) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty()) table.report("name", "an obstacle's name is empty", "", "leave the key out or give a name");
  if (!obstacles_named(problem, name).empty()) {
    const std::string what = fmt::format("two obstacles are named \"{}\"", name);
    if (is_given)
      table.report("name", what, "", "choose another name");
    else
      table.reading().report(table.place(), what, "", "give this one a name, it has none of its own");
  }
  return name;
}

/// Adds one obstacle for each face that it may meet.
void add_faces(obstacle::Obstacle body, const std::string& face, problem::Problem& problem) {
  using obstacle::Face;
  if (face == "both") {
    body.is_for_both = true;
    obstacle::Obstacle other = body;
    body.name += of_lower_face;
    other.name += of_upper_face;
    other.face = Face::upper;
    body.face = Face::lower;
    problem.shell.obstacles.all.push_back(std::move(body));
    problem.shell.obstacles.all.push_back(std::move(other));
    return;
  }
  body.face = face == "lower" ? Face::lower : face == "upper" ? Face::upper : Face::nearer;
  problem.shell.obstacles.all.push_back(std::move(body));
}

}  // namespace

void read_obstacles(Table& root, problem::Problem& problem) {
  auto& effective = root.effective["obstacle"] = nlohmann::json::array();
  for (Table& table : root.tables("obstacle")) {
    obstacle::Obstacle result;
    result.name = read_obstacle_name(table, problem, effective.size() + 1);
    if (auto shape = read_shape(table)) result.shape = std::move(*shape);
    result.placement = read_motion(table).value_or(obstacle::Motion{}).after(1);
    result.force = table.vector("force").value_or(Eigen::Vector3d::Zero());
    const std::string face = table.text("face").value_or("auto");
    if (face == "both" && result.is_pressed())
      table.report("force", "an obstacle that both faces may touch cannot be pressed by a force", "",
                   "say which face touches it: lower, upper or auto");
    add_faces(std::move(result), face, problem);
    effective.push_back(table.effective);
  }
}

}  // namespace plastron::config
