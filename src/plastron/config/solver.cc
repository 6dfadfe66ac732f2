// Reads [contact], [model], [modes] and [solver].
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

using contact::Settings;

Section contact_section() {
  return {"contact",
          "[contact]",
          "Solution of the contact problem.",
          {key("linearised", &assembly::RigidObstacles::are_linear, {.fallback = "false"},
               "true: linearise the gaps of curved obstacles once, at the undeformed shell, and not again at the "
               "deformed shell"),
           key("admissible", &problem::Problem::admissible, {.fallback = "false"},
               "true: keep the shell out of the obstacles between its nodes, too. Bounds are lifted and the problem is "
               "solved again until this holds")}};
}

Section model_section() {
  return {
      "model",
      "[model]",
      "Validity of the linear model.",
      {key("check", &problem::Problem::checks_model, {.fallback = "true"},
           "false: do not compare the solution with the model of finite rotations. The comparison gives its energy and "
           "reactions to some per cent, at the cost of one to eight contact problems on one of the meshes")}};
}

Section modes_section() {
  const Range counts = Range::between(0, 200);
  return {
      "modes",
      "[modes]",
      "Buckling loads and natural frequencies about the solution (the last one, with steps), with the touching nodes "
      "held on their obstacles. Shapes are fields of solution.vtu. The command plastron modes asks for six of both.",
      {key("buckling", &problem::Modes::buckling, {.fallback = "0", .range = counts},
           "number of factors of the loads, prescribed displacements and contact forces, all together, at which the "
           "shell buckles; the smallest positive ones"),
       key("vibration", &problem::Modes::vibration, {.fallback = "0", .range = counts},
           "number of natural frequencies, the lowest ones; they need a density. The stresses of the solution change "
           "them. An unloaded shell needs no supports: its rigid motions have the frequency 0")}};
}

Section solver_section() {
  const Range tolerance = Range::positive(0.01);
  return {"solver",
          "[solver]",
          "Limits of iterations and tolerances. The defaults suffice in nearly all cases.",
          {key("max_iterations", &Settings::max_iterations, {.fallback = "200", .range = Range::between(1, 100000)},
               "largest number of active-set changes on one mesh; each costs one factorisation"),
           key("linear_tolerance", &Settings::linear_tolerance, {.fallback = "1e-12", .range = tolerance},
               "largest relative residual of the linear solves"),
           key("gap_tolerance", &Settings::gap_tolerance, {.fallback = "1e-11", .range = tolerance},
               "a bound counts as violated beyond this multiple of the largest unknown with a bound"),
           key("multiplier_tolerance", &Settings::multiplier_tolerance, {.fallback = "1e-10", .range = tolerance},
               "a multiplier counts as negative beyond this multiple of the largest one")}};
}

}  // namespace

std::vector<Section> solver_sections() {
  return {contact_section(), model_section(), modes_section(), solver_section()};
}

void read_contact(Table& root, problem::Problem& problem) {
  root.in_table("contact", [&](Table& contact) {
    contact.fill(problem.shell.obstacles);
    contact.fill(problem);
    if (problem.shell.obstacles.are_linear && problem.shell.obstacles.has_segments())
      contact.report("linearised", "the table of a bed is met at the deformed shell", "false",
                     "remove linearised = true, or give the bed one stiffness");
    if (problem.admissible && problem.shell.obstacles.on_bed())
      contact.report("admissible", "a bed gives way, also between nodes: nothing is to be lifted there", "false",
                     "remove admissible = true");
  });
}

void read_model(Table& root, problem::Problem& problem) {
  root.in_table("model", [&](Table& model) { model.fill(problem); });
}

void read_modes(Table& root, problem::Problem& problem) {
  root.in_table("modes", [&](Table& modes) {
    modes.fill(problem.modes);
    if (problem.modes.vibration > 0 && !problem.shell.sections.has_mass())
      modes.report("vibration", "natural frequencies need a density, and the shell has none", "0 without a density",
                   "add density = 7850 to [shell]");
  });
}

void read_solver(Table& root, problem::Problem& problem) {
  root.in_table("solver", [&](Table& solver) { solver.fill(problem.contact); });
}

}  // namespace plastron::config
