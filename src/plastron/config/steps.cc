// Reads [[step]] and [[step.move]], and the motions of obstacles.
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>
#include <plastron/geometry/quotation.hpp>

#include <cmath>
#include <limits>

namespace plastron::config {

namespace {

/// Largest number of instants in total: each needs a solution and a file.
constexpr int most_parts = 5000;

/// `kind`: "step" or "case".
std::string read_name(Table& table, const problem::Problem& problem, const char* kind) {
  std::string name = fmt::format("{}-{}", kind, problem.steps.size() + 1);
  if (table.has("name")) name = table.text("name").value_or(name);
  table.effective["name"] = name;
  if (name.empty())
    table.report("name", fmt::format("a {}'s name is empty", kind), "", "leave the key out or give a name");
  if (std::ranges::count(problem.steps, name, &problem::Step::name) > 0)
    table.report("name", fmt::format("two {}s are named \"{}\"", kind, name), "", "choose another name");
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

/// Whether the name at a place of Problem::factor_names is one of a support.
bool is_support(const problem::Problem& problem, std::size_t name) {
  return std::ranges::any_of(problem.shell.supports, [&](const assembly::Support& support) {
    return support.factor == static_cast<int>(name);
  });
}

/// Whether the name is one of prescribed motions alone: of a support, or of a rigid body without force and moment.
bool is_of_motions(const problem::Problem& problem, std::size_t name) {
  const auto body = std::ranges::find(problem.rigid_bodies, static_cast<int>(name), &fem::RigidBody::factor);
  return is_support(problem, name) ||
         (body != problem.rigid_bodies.end() && body->force.isZero(0) && body->moment.isZero(0));
}

/// Returns the place of a name that some section has; reports others.
std::optional<std::size_t> known_factor(const Table& table, const toml::value& value, const std::string& name,
                                        const problem::Problem& problem) {
  const auto& known = problem.factor_names;
  const auto found = std::ranges::find(known, name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  table.reading().report(
      value, fmt::format("nothing that has a factor is named \"{}\"", geometry::shortened(name)), joined(known),
      known.empty() ? "give a [[load]], a [[support]] or a [[temperature]] a name" : did_you_mean(name, known));
  return {};
}

/// Sets the factor of a name from this step on. Before it was that of all loads, or of all supports.
void set_factor(std::size_t name, double value, problem::Problem& problem, problem::Step& step) {
  if (std::isnan(step.factors.named[name]))
    for (problem::Step& before : problem.steps)
      before.factors.named[name] = is_of_motions(problem, name) ? before.factors.supports : before.factors.loads;
  step.factors.named[name] = value;
}

void read_factors(Table& table, bool is_case, problem::Problem& problem, problem::Step& step) {
  const toml::value given = table.value("factors").value();
  if (!given.is_table()) return report_kind(table.reading(), Item{given, "factors"}, Kind::table);
  nlohmann::json& effective = table.effective["factors"] = nlohmann::json::object();
  for (const auto& [name, value] : entries(table.reading(), given)) {
    const auto place = known_factor(table, value, name, problem);
    const auto factor = read_number(table.reading(), Item{value, name});
    if (!place || !factor) continue;
    if (!is_case && std::isnan(step.factors.named[*place]) &&
        std::ranges::any_of(problem.steps, [](const problem::Step& before) { return before.control.has_value(); }))
      table.reading().report(
          value, fmt::format("\"{}\" has no factor before this step, and a step before it has control", name), "",
          "give it a factor in the first step");
    if (is_case)
      step.factors.named[*place] = *factor;
    else
      set_factor(*place, *factor, problem, step);
  }
  for (std::size_t k = 0; k < problem.factor_names.size(); ++k)
    if (!std::isnan(step.factors.named[k])) effective[problem.factor_names[k]] = step.factors.named[k];
}

/// Reads the name of the loads that follow.
void read_controlled_loads(Table& given, const Table& table, problem::Problem& problem, problem::Control& control,
                           problem::Step& step) {
  const toml::value value = given.value("load").value();
  const auto place = known_factor(given, value, control.load, problem);
  if (!place) return;
  control.factor = static_cast<int>(*place);
  if (is_of_motions(problem, *place))
    given.reading().report(value, fmt::format("\"{}\" is no load: control seeks the factor of loads", control.load));
  if (const auto factors = table.value("factors"); factors->is_table() && factors->as_table().count(control.load) > 0)
    given.reading().report(value, fmt::format("the step gives a factor to \"{}\", and control seeks it", control.load),
                           "one of the two", "remove one of them");
  if (std::isnan(step.factors.named[*place])) set_factor(*place, 0, problem, step);
}

void read_control(Table& table, problem::Problem& problem, problem::Step& step) {
  const bool had_control = step.control.has_value();
  const std::string loads_before = had_control ? step.control->load : "";
  step.control.reset();
  if (table.has("control")) {
    problem::Control control;
    table.in_table("control", [&](Table& given) {
      if (!given.fill(control)) return;
      if (had_control && control.load != loads_before)
        given.report_here("the step before controls other loads", loads_before.empty() ? "no load" : loads_before,
                          "control the same loads: the factor at the end of that step is not known before");
      if (given.has("load")) read_controlled_loads(given, table, problem, control, step);
      step.control = std::move(control);
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

/// Reads the supports that the step releases and holds.
void read_released(Table& table, const problem::Problem& problem, problem::Step& step) {
  for (const char* key : {"release", "hold"}) {
    const auto names = table.texts(key);
    if (!names) continue;
    const toml::value list = table.value(key).value();
    for (std::size_t i = 0; i < names->size(); ++i) {
      const toml::value& value = list.as_array()[i];
      const auto place = known_factor(table, value, (*names)[i], problem);
      if (!place) continue;
      if (!is_support(problem, *place))
        table.reading().report(value, fmt::format("\"{}\" is not a support", (*names)[i]));
      step.factors.released.resize(problem.factor_names.size(), 0);
      const bool releases = key == std::string_view("release"), is_released = step.factors.released[*place] != 0;
      if (releases == is_released)
        table.reading().report(value, fmt::format("the support \"{}\" {}", (*names)[i],
                                                  releases ? "is released already" : "is not released"));
      if (!releases && std::ranges::count(table.texts("release").value_or(std::vector<std::string>{}), (*names)[i]) > 0)
        table.reading().report(value, fmt::format("the step releases \"{}\", too", (*names)[i]));
      step.factors.released[*place] = releases ? 1 : 0;
    }
  }
}

/// Whether the case has loads. Initial strains of layers are loads.
bool has_loads(const problem::Problem& problem) {
  const energy::Loads& loads = problem.shell.loads;
  const auto is_loaded = [](const fem::RigidBody& body) { return !body.force.isZero(0) || !body.moment.isZero(0); };
  return !loads.empty() || problem.shell.sections.have_initial_strains() ||
         std::ranges::any_of(problem.rigid_bodies, is_loaded);
}

/// Reads the envelopes, which are made from the results (io/envelopes.hpp).
void read_envelopes(Table& root, problem::Problem& problem) {
  std::vector<problem::Envelope>& envelopes = problem.output.envelopes;
  std::vector<std::string> known;
  for (const problem::Step& load_case : problem.steps) known.push_back(load_case.name);
  root.in_tables("envelope", [&](Table& table) {
    std::string own = fmt::format("envelope-{}", envelopes.size() + 1);
    std::vector<std::string> cases = known;
    if (!problem.steps_are_cases) table.report_here("[[envelope]] has no load cases", "", "add two sections [[case]]");
    if (table.has("name")) own = table.text("name").value_or(own);
    check_file_name(table, own, "an envelope");
    if (table.has("cases")) cases = table.texts("cases").value_or(known);
    table.effective["name"] = own;
    table.effective["cases"] = cases;
    if (table.has("cases") && cases.empty()) table.report("cases", "cases names no [[case]]", joined(known));
    for (std::size_t k = 1; k < cases.size(); ++k)
      if (std::find(cases.begin(), cases.begin() + static_cast<std::ptrdiff_t>(k), cases[k]) !=
          cases.begin() + static_cast<std::ptrdiff_t>(k))
        table.report("cases", fmt::format("the case \"{}\" is named twice", cases[k]));
    for (const std::string& name : cases)
      if (problem.steps_are_cases && std::ranges::count(known, name) == 0)
        table.report("cases", fmt::format("there is no [[case]] \"{}\"", geometry::shortened(name)), joined(known),
                     did_you_mean(name, known));
    if (std::ranges::count(envelopes, own, &problem::Envelope::name) > 0)
      table.report_here(fmt::format("two [[envelope]] are named \"{}\"", own), "", "choose another name");
    envelopes.push_back({std::move(own), std::move(cases)});
  });
}

/// Reads the load cases as steps. What some case names has the factor 0 in the cases that do not name it.
void read_cases(Table& root, problem::Problem& problem) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t names = problem.factor_names.size();
  std::vector<char> is_named(names, 0);
  root.in_tables("case", [&](Table& table) {
    problem::Step load_case{.factors = {.forces = std::vector<double>(problem.shell.obstacles.all.size(), 1),
                                        .named = std::vector<double>(names, none)}};
    load_case.name = read_name(table, problem, "case");
    load_case.factors.loads = table.number("loads").value_or(1);
    load_case.factors.supports = table.number("supports").value_or(1);
    read_factors(table, true, problem, load_case);
    for (std::size_t k = 0; k < names; ++k) is_named[k] = is_named[k] || !std::isnan(load_case.factors.named[k]);
    for (obstacle::Obstacle& o : problem.shell.obstacles.all) o.motions.emplace_back();
    problem.steps.push_back(std::move(load_case));
  });
  problem.steps_are_cases = !problem.steps.empty();
  for (problem::Step& load_case : problem.steps)
    for (std::size_t k = 0; k < names; ++k)
      if (is_named[k] && std::isnan(load_case.factors.named[k])) load_case.factors.named[k] = 0;
  const auto steps = root.value("step");
  if (problem.steps_are_cases && steps && steps->is_array() && !steps->as_array().empty())
    root.report_key("case", "the file has steps and load cases", "one of the two",
                    "put the load cases into a file of their own");
}

Section case_section() {
  return {
      "case",
      "[[case]]",
      "A load case: factors of loads, supports and temperatures that have a name. Each is computed by itself, from the "
      "undeformed shell; history in results.json has its numbers. Not together with [[step]].",
      {key("name", Kind::name, {}, "a name that no other case has; case-1, case-2, ... if not given"),
       key("factors", Kind::free_table, {.fallback = "{}"},
           "factors of names: { weight = 1, wind = 1.5 }. What some case names has the factor 0 in the others"),
       key("loads", Kind::number, {.fallback = "1"}, "factor of loads that no case names"),
       key("supports", Kind::number, {.fallback = "1"}, "factor of values of supports that no case names")}};
}

Section envelope_section() {
  return {"envelope",
          "[[envelope]]",
          "The least and the largest value of each number over load cases, with the case that has it: envelopes in "
          "results.json. envelope-NAME.vtu has those of the fields.",
          {key("name", Kind::name, {},
               "a name that no other envelope has, of letters, digits, - and _; envelope-1, ... if not given"),
           key("cases", Kind::names, {}, "names of [[case]]; all of them if not given")}};
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
       key("factors", Kind::free_table, {.fallback = "{}"},
           "factors at the end of the step of what has a name, in the place of loads or supports: { weight = 1, wind = "
           "0.5 }. A factor that is not given stays, and a name that has none yet follows loads or supports"),
       key("release", Kind::names, {.fallback = "[]"},
           "names of supports that hold nothing from the beginning of this step on"),
       key("hold", Kind::names, {.fallback = "[]"}, "names of released supports that hold again"),
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
           "u . direction at the end of the step"),
       key("load", &Control::load, {},
           "name of the loads or temperatures that follow, while all others stay as `factors` say; all loads without a "
           "factor of their own if not given")}};
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
  return {step_section(), control_section(), move_section(), rotate_section("step.move.rotate"),
          case_section(), envelope_section()};
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
  read_cases(root, problem);
  read_envelopes(root, problem);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  problem::Step step{.factors = {.forces = std::vector<double>(problem.shell.obstacles.all.size(), 1),
                                 .named = std::vector<double>(problem.factor_names.size(), none)}};
  int parts = 0;
  root.in_tables("step", [&](Table& table) {
    step.name = read_name(table, problem, "step");
    if (table.has("loads")) step.factors.loads = table.number("loads").value_or(1);
    if (!table.has("control")) table.effective["loads"] = step.factors.loads;
    if (table.has("supports")) step.factors.supports = table.number("supports").value_or(1);
    table.effective["supports"] = step.factors.supports;
    read_factors(table, false, problem, step);
    read_released(table, problem, step);
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
