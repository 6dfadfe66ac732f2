#include <plastron/config/output_schema.hpp>

namespace plastron::config {

Section output_section() {
  return {"output",
          "[output]",
          "How results are given.",
          {{.name = "axis",
            .kind = Kind::vector,
            .unit = "1",
            .meaning =
                "t1, the first axis of N, M, Q and stresses, is this direction projected on the surface; without it, "
                "or where it is normal to the surface, the tangent d phi/dx"},
           {.name = "resultants",
            .kind = Kind::word,
            .fallback = "\"smooth\"",
            .words = {{"smooth"}, {"by-cell"}},
            .meaning = "N, M, Q and stresses recovered over the cells round each vertex, or of each cell alone, as the "
                       "elements have them"},
           {.name = "moment_point",
            .kind = Kind::vector,
            .unit = "m",
            .fallback = "[0, 0, 0]",
            .meaning = "moments of loads, reactions and supports are about this point"},
           {.name = "heights",
            .kind = Kind::numbers,
            .unit = "1",
            .fallback = "[]",
            .meaning = "heights over the mid-surface, z / e from -0.5 to 0.5, at which line-NAME.csv and the .vtu "
                       "files have stresses, besides both faces and the middle"},
           {.name = "solid",
            .kind = Kind::boolean,
            .fallback = "false",
            .meaning = "solid.vtu: the deformed shell with its thickness, and stresses inside of it"},
           {.name = "layers",
            .kind = Kind::integer,
            .fallback = "4",
            .range = {.low = 1, .high = 20},
            .meaning = "layers of cells through the thickness in solid.vtu"},
           {.name = "precision",
            .kind = Kind::word,
            .fallback = "\"single\"",
            .words = {{"single"}, {"double"}},
            .meaning = "of the numbers in solution.vtu and solid.vtu; double ones take twice the space"},
           {.name = "report",
            .kind = Kind::boolean,
            .fallback = "true",
            .meaning = "report.html, a page with tables, plots and the shell in three dimensions; --no-report refuses "
                       "it, too"}}};
}

Section units_section() {
  return {"units",
          "[units]",
          "What the units are called that the case is written in. Numbers do not change: any units will do that fit "
          "together, and without this section texts and files say m, N, J and Pa.",
          {{.name = "length", .kind = Kind::name, .fallback = "\"m\"", .meaning = "the unit of length, such as mm"},
           {.name = "force",
            .kind = Kind::name,
            .fallback = "\"N\"",
            .meaning = "the unit of force, such as kN; E is then in force / length^2: MPa for N and mm"}}};
}

}  // namespace plastron::config
