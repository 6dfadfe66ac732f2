// Reads [[step]] and [[step.move]], and the motions of obstacles.
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>

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
  if (factor) step.factors.forces[k] = *factor;
}

void read_control(Table& table, const problem::Problem& problem, problem::Step& step) {
  const bool had_control = step.control.has_value();
  step.control.reset();
  if (table.has("control")) {
    problem::Control control;
    table.in_table("control", [&](Table& given) {
      if (given.fill(control)) step.control = std::move(control);
    });
    if (table.has("loads"))
      table.report("loads", "the step gives loads, and control seeks them", "one of the two", "remove one of them");
    const auto move = table.value("move");
    if (move && !(move->is_array() && move->as_array().empty()))
      table.report("move", "obstacles do not move in a step with control", "", "move them in a step before");
    if (std::ranges::any_of(problem.shell.obstacles.all, &obstacle::Obstacle::is_pressed))
      table.report("control", "control has no meaning beside obstacles that a force presses", "",
                   "move them by `translate`");
  } else if (had_control) {
    table.report_here("the step has no control, and the step before has one", "",
                      "give it control, too: the loads at its start are not known before");
  }
}

/// Whether the case has loads. Initial strains of layers are loads.
bool has_loads(const problem::Problem& problem) {
  const assembly::Loads& loads = problem.shell.loads;
  const auto is_loaded = [](const fem::RigidBody& body) { return !body.force.isZero(0) || !body.moment.isZero(0); };
  return !loads.on_areas.empty() || !loads.on_edges.empty() || !loads.gravity.isZero(0) ||
         problem.shell.sections.have_initial_strains() || std::ranges::any_of(problem.rigid_bodies, is_loaded);
}

void read_moves(Table& table, const std::vector<std::string>& known, problem::Problem& problem, problem::Step& step) {
  for (obstacle::Obstacle& o : problem.shell.obstacles.all) o.motions.emplace_back();
  std::vector<std::string> seen;
  table.in_tables("move", [&](Table& move) {
    const auto motion = read_motion(move);
    for (const std::size_t k : moved_obstacles(move, problem, known, seen)) {
      if (motion) problem.shell.obstacles.all[k].motions.back() = *motion;
      read_force(move, problem, k, step);
    }
  });
}

Section step_section() {
  return {
      "step",
      "[[step]]",
      "Steps are computed in their order; each starts where the previous one ended. All use the finest mesh. With "
      "[accuracy] meshes follow the shell: each instant has a mesh on which it is accurate (history in results.json "
      "has its cells and estimated errors). In a step "
      "the loads, the values of supports, the forces on obstacles and the motions of obstacles proceed in equal "
      "parts. Before the first step all of them are 0. Without steps the case is computed once, with all of them.",
      {key("name", Kind::name, {}, "a name that no other step has; step-1, step-2, ... if not given"),
       key("loads", Kind::number, {},
           "factor of all loads, including the weight, at the end of the step. If not given, the factor of the "
           "previous step; in the first step 1"),
       key("supports", Kind::number, {},
           "factor of the values of supports and rigid bodies at the end of the step. If not given, the factor of "
           "the previous step; in the first step 1"),
       key("parts", Kind::integer_or_word, {.fallback = "1", .range = Range::between(1, 1000), .words = {"auto"}},
           "number of equal parts of the step; each is solved and appears in the history. auto: parts are as long as "
           "the iteration allows, and shorter where it finds no equilibrium or the shell jumps to another one"),
       key("control", Kind::table, {}, "the displacement that the loads follow, in the place of `loads`"),
       key("move", Kind::tables, {.fallback = "[]"}, "motions of obstacles in this step")}};
}

Section control_section() {
  using problem::Control;
  return {
      "step.control",
      "control",
      "The loads follow a displacement: their factor is sought with which u . direction of a probe proceeds in equal "
      "parts. Such a step passes limit points of the loads. It needs finite rotations, and moves no obstacles. "
      "Steps after it have control, too.",
      {key("probe", &Control::probe, {.required = true, .example = "\"crown\""}, "name of a [[probe]]"),
       key("direction", &Control::direction, &Table::direction, {.kind = Kind::vector, .fallback = "[0, 0, 1]"},
           "direction of the displacement; any length except 0"),
       key("to", &Control::to, {.unit = "m", .required = true, .example = "-0.1"},
           "u . direction at the end of the step")}};
}

Section move_section() {
  return {"step.move",
          "[[step.move]]",
          "Motion of an obstacle in the step above: first a rotation, then a translation. It starts where the previous "
          "step ended.",
          {key("obstacle", Kind::name, {.required = true, .example = "\"tool\""}, "name of the obstacle"),
           key("rotate", Kind::table, {}, "rotation in the whole step"),
           key("translate", &obstacle::Motion::translation, {.unit = "m", .fallback = "[0, 0, 0]"},
               "translation in the whole step"),
           key("force", Kind::number, {.range = {.low = 0}},
               "factor of the obstacle's force at the end of the step. If not given, the factor of the previous step; "
               "in the first step 1. With 0 the obstacle exerts no force: the shell springs back, and the obstacle "
               "stands where the shell leaves it")}};
}

}  // namespace

std::vector<Section> step_sections() {
  return {step_section(), control_section(), move_section(), rotate_section("step.move.rotate")};
}

Section rotate_section(const std::string& path) {
  using obstacle::Motion;
  return {path,
          "rotate",
          "A rotation about a line by the right-hand rule.",
          {key("axis", &Motion::axis, &Table::direction, {.kind = Kind::vector, .fallback = "[0, 0, 1]"},
               "direction of the line; any length except 0"),
           key("angle", &Motion::angle,
               {.unit = "rad", .required = true, .range = Range::between(-6.2832, 6.2832), .example = "\"pi/2\""},
               "angle of the rotation, at most a whole turn"),
           key("about", &Motion::about, {.unit = "m", .fallback = "[0, 0, 0]"}, "a point of the line")}};
}

std::optional<obstacle::Motion> read_motion(Table& table) {
  obstacle::Motion motion;
  bool is_right = table.fill(motion);
  if (table.has("rotate") &&
      !table.in_table("rotate", [&](Table& rotate) { is_right = rotate.fill(motion) && is_right; }))
    return {};
  return is_right ? std::optional(motion) : std::nullopt;
}

void check_control(Table& root, const problem::Problem& problem) {
  std::vector<std::string> names;
  for (const problem::Probe& probe : problem.probes) names.push_back(probe.name);
  root.in_tables("step", [&](Table& table) {
    if (!table.has("control")) return;
    if (problem.shell.rotations == element::Rotations::small)
      table.report("control", "control needs finite rotations: the linear model has no limit points", "",
                   "write rotations = \"finite\" in [shell]");
    if (!has_loads(problem))
      table.report("control", "control seeks the factor of the loads, and the case has no loads", "", "add a [[load]]");
    if (problem.accuracy)
      table.report("control", "[accuracy] does not work with control", "", "write refinements in [mesh] in its place");
    table.in_table("control", [&](Table& control) {
      const auto probe = control.text("probe");
      if (probe && std::ranges::count(names, *probe) == 0)
        control.report("probe", fmt::format("there is no probe \"{}\"", *probe), joined(names),
                       did_you_mean(*probe, names));
    });
  });
}

void read_steps(Table& root, problem::Problem& problem) {
  problem::Step step{.factors = {.forces = std::vector<double>(problem.shell.obstacles.all.size(), 1)}};
  int parts = 0;
  root.in_tables("step", [&](Table& table) {
    step.name = read_step_name(table, problem);
    if (table.has("loads")) step.factors.loads = table.number("loads").value_or(1);
    if (!table.has("control")) table.effective["loads"] = step.factors.loads;
    if (table.has("supports")) step.factors.supports = table.number("supports").value_or(1);
    table.effective["supports"] = step.factors.supports;
    read_control(table, problem, step);
    step.chooses_parts = table.has("parts") && table.value("parts")->is_string();
    step.parts = 1;
    if (step.chooses_parts)
      table.text("parts");
    else
      step.parts = table.integer("parts").value_or(1);
    if (step.parts > 0 && (parts += step.parts) > most_parts)
      table.report("parts", fmt::format("the steps have more than {} parts in all", most_parts));
    read_moves(table, obstacle_names(root), problem, step);
    problem.steps.push_back(step);
  });
}

}  // namespace plastron::config
