#include <fmt/format.h>
#include <plastron/config/geometry_schema.hpp>
#include <plastron/config/obstacle_schema.hpp>
#include <plastron/config/output_schema.hpp>
#include <plastron/config/rigid_body_schema.hpp>
#include <plastron/config/shell_schema.hpp>
#include <plastron/config/step_schema.hpp>

#include <algorithm>
#include <stdexcept>

namespace plastron::config {

namespace {

Range between(double low, double high) { return {.low = low, .high = high}; }

Section file_section() {
  return {
      "",
      "the case file",
      "A case file is a TOML file of these sections.",
      {{.name = "title", .kind = Kind::text, .fallback = "\"\"", .meaning = "shown in reports"},
       {.name = "constants", .kind = Kind::free_table, .fallback = "{}", .meaning = "named numbers for expressions"},
       {.name = "shell", .kind = Kind::table, .required = true, .meaning = "material and thickness"},
       {.name = "geometry", .kind = Kind::table, .required = true, .meaning = "the mid-surface"},
       {.name = "region",
        .kind = Kind::tables,
        .fallback = "[]",
        .meaning = "thickness, material, density of a region"},
       {.name = "accuracy", .kind = Kind::table, .fallback = "{}", .meaning = "how accurate results are to be"},
       {.name = "mesh", .kind = Kind::table, .fallback = "{}", .meaning = "the discretisation"},
       {.name = "join", .kind = Kind::tables, .fallback = "[]", .meaning = "edges that are joined"},
       {.name = "rigid_body", .kind = Kind::tables, .fallback = "[]", .meaning = "rigid bodies that carry edges"},
       {.name = "support", .kind = Kind::tables, .fallback = "[]", .meaning = "prescribed displacements and rotations"},
       {.name = "load", .kind = Kind::tables, .fallback = "[]", .meaning = "dead loads"},
       {.name = "gravity", .kind = Kind::table, .fallback = "{}", .meaning = "what makes the weight of the shell"},
       {.name = "obstacle", .kind = Kind::tables, .fallback = "[]", .meaning = "rigid obstacles"},
       {.name = "step", .kind = Kind::tables, .fallback = "[]", .meaning = "loads and obstacles that change in steps"},
       {.name = "probe", .kind = Kind::tables, .fallback = "[]", .meaning = "points where results are wanted"},
       {.name = "line", .kind = Kind::tables, .fallback = "[]", .meaning = "lines along which results are tabulated"},
       {.name = "output", .kind = Kind::table, .fallback = "{}", .meaning = "how results are given"},
       {.name = "units", .kind = Kind::table, .fallback = "{}", .meaning = "what the units are called"},
       {.name = "contact", .kind = Kind::table, .fallback = "{}", .meaning = "how the contact problem is solved"},
       {.name = "solver", .kind = Kind::table, .fallback = "{}", .meaning = "iteration limits and tolerances"}}};
}

Section constants_section() {
  return {
      "constants",
      "[constants]",
      "Any name = a number or an expression of the constants above it. A name has letters, digits and _, does not "
      "begin with a digit, has at most 60 characters, and is not x, y, pi or a function's name; nor is it a name that "
      "the libraries behind expressions know: log2, log10, rint, sum, avg, sq, cube, step, Pi, I, Euler, Catalan.",
      {}};
}

Section accuracy_section() {
  const Range tolerance = {.low = 1e-10, .high = 0.5};
  return {
      "accuracy",
      "[accuracy]",
      "What is to be accurate, and how: meshes are refined where it matters until twice all estimated errors are below "
      "their tolerances, judged by the errors of recovered stress resultants and by a solution at one degree more on "
      "the same cells (triangles: on two meshes in a row). Tolerances are relative to the number's own size, or to a "
      "thousandth of the largest of its kind where that is more: a component that vanishes by symmetry has no digits; "
      "that of all obstacles together is relative to the sum of what each bears, and holds for each one's own force, "
      "too. Without [mesh] and [accuracy] the tolerances of energy and reaction are 1e-3. All triangles are refined "
      "together, and so are cells along joined edges and along edges of rigid bodies. A mesh that would not fit into "
      "the memory of the machine is not "
      "begun; then the status is accuracy_not_reached.",
      {{.name = "energy", .range = tolerance, .meaning = "tolerance of the stored energy"},
       {.name = "reaction",
        .range = tolerance,
        .meaning = "tolerance of the norm of the obstacles' reaction, of all together and of each"},
       {.name = "contact_area", .range = tolerance, .meaning = "tolerance of the area of the contact zones"},
       {.name = "max_unknowns",
        .fallback = "2e6",
        .range = {.low = 1},
        .meaning = "no solution has more unknowns, nor the one that judges it; if that does not do, the status is "
                   "accuracy_not_reached"},
       {.name = "max_seconds",
        .unit = "s",
        .range = Range::above_to(0, std::numeric_limits<double>::infinity()),
        .meaning = "no mesh is begun that would end later, steps on it included, and the first mesh apart none goes on "
                   "beyond; if that does not do, the status is accuracy_not_reached"}},
      {},
      "tolerances of other numbers of results.json, by their names in quotes: \"probe.NAME.u.z\" and its like for u, "
      "r, N, M, Q; \"probe.NAME.stress_upper.11\", stress_middle, stress_lower, .von_mises; \"stress\", the largest "
      "of von Mises; "
      "\"support.BOUNDARY.force.z\"; \"obstacle.NAME.force.z\", .area and, of one that a force presses, .position; "
      "load_work"};
}

Section mesh_section() {
  return {"mesh",
          "[mesh]",
          "The finite elements, where they are not left to [accuracy].",
          {{.name = "cells",
            .kind = Kind::word,
            .fallback = "\"quadrilateral\"",
            .words = {{"quadrilateral"}, {"triangle"}},
            .meaning = "shape of the cells; triangles have degree 1 or 2 and no tying"},
           {.name = "degree",
            .kind = Kind::integer,
            .fallback = "2",
            .range = between(1, 8),
            .meaning = "degree of u and r; where meshes follow from [accuracy] 4 if not given, 2 on triangles"},
           {.name = "tying",
            .kind = Kind::boolean,
            .fallback = "true",
            .meaning = "strains tied against locking; false on triangles"},
           {.name = "layers",
            .kind = Kind::word_or_false,
            .fallback = "false",
            .words = {{"auto"}},
            .meaning = "\"auto\": rows of long thin cells along the edges, as wide as the edge layers of the shell ask "
                       "for, and cells between them "
                       "that on the finest mesh are small enough for an error of about 1e-3 (methods/layers.md); a "
                       "mesh that is read is left as it "
                       "is; `plastron check` says what the rows are. Where meshes follow from [accuracy] \"auto\" if "
                       "not given, on triangles false"},
           {.name = "refinements",
            .kind = Kind::integer,
            .fallback = "3",
            .range = between(0, 12),
            .meaning = "uniform refinements of the coarsest mesh; every level is solved. With [accuracy], or without "
                       "[mesh], 0 if not given, and only the last level begins the meshes that follow"}}};
}

Section join_section() {
  return {
      "join",
      "[[join]]",
      "Two edges that lie on each other in space and are joined there: a rectangle closes to a tube, or pieces of "
      "a mesh file "
      "make one shell. Where they meet at an angle, they share u and the rotation about the edge; a3 must not point to "
      "opposite sides.",
      {{.name = "boundaries",
        .kind = Kind::names,
        .required = true,
        .meaning = "the two boundaries of the domain, divided into the same cells",
        .example = "[\"left\", \"right\"]"}}};
}

Section support_section() {
  return {
      "support",
      "[[support]]",
      "Components of the displacement u and of the rotation r prescribed on boundaries, or of u at a point. Three "
      "points "
      "that fix three, two and one component hold the six rigid motions of a shell whose loads are in equilibrium; any "
      "other force at a point is singular in this model, and is warned of.",
      {{.name = "boundary",
        .kind = Kind::name_or_names,
        .meaning = "a boundary of the domain or several; either this or point"},
       {.name = "point",
        .kind = Kind::point,
        .meaning =
            "a node of the coarsest mesh that finer ones keep: a corner of a cell; where the degree is even, the "
            "middle of a side or of a quadrilateral, too. Only u.x, u.y, u.z can be fixed there"},
       {.name = "fix",
        .kind = Kind::names,
        .required = true,
        .words = {{"u"},
                  {"r"},
                  {"u.x"},
                  {"u.y"},
                  {"u.z"},
                  {"u.n"},
                  {"u.t"},
                  {"u.a3"},
                  {"r.x"},
                  {"r.y"},
                  {"r.z"},
                  {"r.n"},
                  {"r.t"},
                  {"r.a3"},
                  {"symmetry"}},
        .meaning =
            "the components: n is tangent to the shell and normal to the edge, outward; t runs along the edge; a3 is "
            "normal to the shell; u and r stand for all three; symmetry is u.n and r.n. Any component of r fixes r.a3, "
            "too",
        .example = "[\"u\", \"r\"]"},
       {.name = "values",
        .kind = Kind::free_table,
        .unit = "m, rad",
        .fallback = "{}",
        .meaning = "values of fixed components, a number or an expression of x, y each: { u.z = -0.01 } or "
                   "{ u = [0, 0, \"-0.01*x\"] }; 0 if not given"}}};
}

Section load_section() {
  return {
      "load",
      "[[load]]",
      "Dead loads, at least one of force, pressure and couple: per area of the mid-surface, or per length of a "
      "boundary's curve if a boundary is named. Several loads add up.",
      {{.name = "boundary",
        .kind = Kind::name_or_names,
        .meaning = "a boundary of the domain or several; without it the load acts on the surface"},
       {.name = "region",
        .kind = Kind::name_or_names,
        .meaning = "a region of the domain or several; without it the load acts on all of the surface. Not together "
                   "with boundary"},
       {.name = "force", .kind = Kind::field_vector, .unit = "N/m^2, N/m", .meaning = "Cartesian force"},
       {.name = "pressure",
        .kind = Kind::field,
        .unit = "N/m^2",
        .meaning = "force along the normal a3; not on a boundary"},
       {.name = "couple",
        .kind = Kind::field_vector,
        .unit = "N m/m^2, N m/m",
        .meaning = "Cartesian vector that works on r"}}};
}

Section probe_section() {
  return {
      "probe",
      "[[probe]]",
      "A point where displacements, resultants and gap are reported.",
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .meaning = "a name no other probe has",
        .example = "\"centre\""},
       {.name = "at", .kind = Kind::point, .required = true, .meaning = "a point of the domain", .example = "[0, 0]"}}};
}

Section line_section() {
  return {"line",
          "[[line]]",
          "Points of the domain along which every field is written, a row a point, to line-NAME.csv.",
          {{.name = "name",
            .kind = Kind::name,
            .required = true,
            .meaning = "a name no other line has, of letters, digits, - and _",
            .example = "\"meridian\""},
           {.name = "through", .kind = Kind::points, .meaning = "two points or more, joined by straight pieces"},
           {.name = "arc", .kind = Kind::table, .meaning = "an arc of a circle instead"},
           {.name = "points",
            .kind = Kind::integer,
            .fallback = "101",
            .range = between(2, 10000),
            .meaning = "equidistant in the domain, the ends included"}}};
}

Section arc_section() {
  return {"line.arc",
          "arc",
          "An arc in the parameter plane.",
          {{.name = "centre", .kind = Kind::point, .fallback = "[0, 0]", .meaning = "its centre"},
           {.name = "radius",
            .required = true,
            .range = Range::above_to(0, std::numeric_limits<double>::infinity()),
            .meaning = "its radius",
            .example = "0.5"},
           {.name = "from", .unit = "degrees", .fallback = "0", .meaning = "angle from the x axis where it begins"},
           {.name = "to", .unit = "degrees", .fallback = "360", .meaning = "angle where it ends"}}};
}

Section contact_section() {
  return {
      "contact",
      "[contact]",
      "How the contact problem is solved.",
      {{.name = "linearised",
        .kind = Kind::boolean,
        .fallback = "false",
        .meaning =
            "take the gaps of curved obstacles at the undeformed shell, and not again where the shell was found"},
       {.name = "admissible",
        .kind = Kind::boolean,
        .fallback = "false",
        .meaning = "keep the shell out of the obstacles between its nodes, too: solve again with lifted bounds until "
                   "it is"}}};
}

Section solver_section() {
  return {"solver",
          "[solver]",
          "The defaults serve nearly always.",
          {{.name = "max_iterations",
            .kind = Kind::integer,
            .fallback = "200",
            .range = between(1, 100000),
            .meaning = "active-set changes on one mesh; each costs one factorisation"},
           {.name = "linear_tolerance",
            .fallback = "1e-12",
            .range = Range::above_to(0, 0.01),
            .meaning = "relative residual of the linear solves"},
           {.name = "gap_tolerance",
            .fallback = "1e-11",
            .range = Range::above_to(0, 0.01),
            .meaning = "a bound counts as violated beyond this multiple of the largest unknown that has one"},
           {.name = "multiplier_tolerance",
            .fallback = "1e-10",
            .range = Range::above_to(0, 0.01),
            .meaning = "a multiplier counts as negative beyond this multiple of the largest one"}}};
}

std::vector<Section> all_sections() {
  std::vector<Section> all{file_section(), constants_section()};
  const auto append = [&](std::vector<Section> more) { all.insert(all.end(), more.begin(), more.end()); };
  append(shell_sections());
  append(geometry_sections());
  append({accuracy_section(), mesh_section(), join_section(), rigid_body_section(), support_section(), load_section()});
  append(obstacle_sections());
  append(step_sections());
  append({probe_section(), line_section(), arc_section(), output_section(), units_section(), contact_section(),
          solver_section()});
  return all;
}

}  // namespace

const std::vector<Section>& sections() {
  static const std::vector<Section> all = all_sections();
  return all;
}

const Section& section(const std::string& path) {
  const auto found = std::ranges::find(sections(), path, &Section::path);
  if (found == sections().end()) throw std::logic_error("no section is declared as " + path);
  return *found;
}

}  // namespace plastron::config
