#include <plastron/config/obstacle_schema.hpp>
#include <plastron/config/step_schema.hpp>

namespace plastron::config {

namespace {

Section step_section() {
  return {
      "step",
      "[[step]]",
      "Steps are computed in their order on the finest mesh, each from where the one before has ended. In a step "
      "loads, forces on obstacles and the obstacles' motions go on in equal parts; before the first there are no "
      "loads and no forces. Without any step the case is computed once, with all of them.",
      {{.name = "name", .kind = Kind::name, .meaning = "a name no other step has; step-1, step-2, ... if not given"},
       {.name = "loads",
        .meaning = "what all loads, the weight too, are multiplied by at the step's end; if not given, as at the end "
                   "of the step before, in the first step 1"},
       {.name = "parts",
        .kind = Kind::integer,
        .fallback = "1",
        .range = {.low = 1, .high = 1000},
        .meaning = "equal parts of the step; each is solved and stands in the history"},
       {.name = "move", .kind = Kind::tables, .fallback = "[]", .meaning = "what obstacles do in this step"}}};
}

Section move_section() {
  return {
      "step.move",
      "[[step.move]]",
      "What an obstacle does in the step above: first turned, then shifted, from where the step before has left it.",
      {{.name = "obstacle", .kind = Kind::name, .required = true, .meaning = "its name", .example = "\"tool\""},
       {.name = "rotate", .kind = Kind::table, .meaning = "how it turns in the whole step"},
       {.name = "translate",
        .kind = Kind::vector,
        .unit = "m",
        .fallback = "[0, 0, 0]",
        .meaning = "how it shifts in the whole step"},
       {.name = "force",
        .range = {.low = 0},
        .meaning = "what the obstacle's force is multiplied by at the step's end; if not given, as at the end of "
                   "the step before, in the first step 1; at 0 it stays where it is"}}};
}

}  // namespace

std::vector<Section> step_sections() { return {step_section(), move_section(), rotate_section("step.move.rotate")}; }

}  // namespace plastron::config
