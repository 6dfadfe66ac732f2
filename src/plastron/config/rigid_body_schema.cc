#include <plastron/config/rigid_body_schema.hpp>

namespace plastron::config {

Section rigid_body_section() {
  return {
      "rigid_body",
      "[[rigid_body]]",
      "A rigid body that carries edges of the shell, an end plate or a clamp: their nodes move as "
      "u = d + theta x (phi - reference), r = theta x a3, with six unknowns for all of them. Obstacles do not hold "
      "these nodes; how deep the "
      "shell enters there is measured and reported.",
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .meaning = "a name no other body has",
        .example = "\"end plate\""},
       {.name = "boundary",
        .kind = Kind::name_or_names,
        .required = true,
        .meaning = "a boundary of the domain or several; bodies share no nodes",
        .example = "\"right\""},
       {.name = "reference",
        .kind = Kind::vector,
        .unit = "m",
        .required = true,
        .meaning = "the point whose displacement is d, anywhere in space; force and moment act there",
        .example = "[1, 0, 0]"},
       {.name = "rotations",
        .kind = Kind::boolean,
        .fallback = "true",
        .meaning = "r follows the body, too; false: a hinge, which carries u alone"},
       {.name = "fix",
        .kind = Kind::names,
        .fallback = "[]",
        .words = {{"u"}, {"theta"}, {"u.x"}, {"u.y"}, {"u.z"}, {"theta.x"}, {"theta.y"}, {"theta.z"}},
        .meaning = "the components of d, called u, and theta that are prescribed; u and theta stand for all three. "
                   "Supports of the edges may hold nothing of these nodes that is not fixed here"},
       {.name = "values",
        .kind = Kind::free_table,
        .unit = "m, rad",
        .fallback = "{}",
        .meaning = "values of fixed components, a number each: { u.z = -0.01 } or { theta = [0, 0, 0.1] }; 0 if not "
                   "given"},
       {.name = "force",
        .kind = Kind::vector,
        .unit = "N",
        .fallback = "[0, 0, 0]",
        .meaning = "on the body, at the reference point"},
       {.name = "moment",
        .kind = Kind::vector,
        .unit = "N m",
        .fallback = "[0, 0, 0]",
        .meaning = "on the body, about the reference point"}}};
}

}  // namespace plastron::config
