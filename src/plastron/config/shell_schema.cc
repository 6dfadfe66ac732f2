#include <plastron/config/geometry_schema.hpp>
#include <plastron/config/shell_schema.hpp>

namespace plastron::config {

namespace {

Range poisson() { return {.low = -0.999, .high = 0.5, .high_open = true}; }

Section shell_section() {
  return {
      "shell",
      "[shell]",
      "The elastic constants are either E and nu, or lambda and mu.",
      {{.name = "E", .unit = "Pa", .range = positive(), .meaning = "Young's modulus", .example = "2.1e11"},
       {.name = "nu",
        .range = poisson(),
        .meaning = "Poisson's ratio; towards -1 the shell becomes too soft in shape and too stiff in shear for double "
                   "precision",
        .example = "0.3"},
       {.name = "lambda",
        .unit = "Pa",
        .meaning = "first Lame constant, 3 lambda + 2 mu > 0 and Poisson's ratio at least -0.999",
        .example = "1.2e11"},
       {.name = "mu", .unit = "Pa", .range = positive(), .meaning = "shear modulus", .example = "8e10"},
       {.name = "thickness",
        .kind = Kind::field,
        .unit = "m",
        .required = true,
        .range = positive(),
        .meaning = "the thickness e",
        .example = "0.02"},
       {.name = "density",
        .unit = "kg/m^3",
        .range = positive(),
        .meaning = "mass per volume, for the weight under [gravity]"},
       {.name = "shear_correction",
        .fallback = "1",
        .range = Range::above_to(0, 2),
        .meaning = "factor of the transverse shear energy: 1 in the paper, 5/6 on request"},
       {.name = "formulation",
        .kind = Kind::word,
        .fallback = "\"tangent\"",
        .words = {{"tangent"}, {"penalised"}, {"mixed"}, {"classical"}},
        .meaning = "how r . a3 = 0 is kept: two rotations a node, a penalty, a multiplier, covariant components"},
       {.name = "penalty",
        .fallback = "0.1",
        .range = Range::above_to(0, 1),
        .meaning = "p of the penalised formulation; the penalty is E e^3 / p"},
       {.name = "stabilisation",
        .fallback = "1",
        .range = positive(),
        .meaning = "rho of the mixed formulation; the stabilisation is rho E e^3"}}};
}

Section region_section() {
  return {
      "region",
      "[[region]]",
      "What a region of the domain has of its own: at least one of thickness, elastic constants and density. What is "
      "not "
      "given is that of [shell]. Where regions of different thickness meet, strains see each cell's own, the gap at "
      "nodes the largest.",
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .meaning = "a region of the domain, one that no other [[region]] names",
        .example = "\"stiff\""},
       {.name = "thickness", .kind = Kind::field, .unit = "m", .range = positive(), .meaning = "the thickness e"},
       {.name = "E", .unit = "Pa", .range = positive(), .meaning = "Young's modulus, together with nu"},
       {.name = "nu", .range = poisson(), .meaning = "Poisson's ratio, together with E"},
       {.name = "lambda", .unit = "Pa", .meaning = "first Lame constant, together with mu"},
       {.name = "mu", .unit = "Pa", .range = positive(), .meaning = "shear modulus, together with lambda"},
       {.name = "density", .unit = "kg/m^3", .range = positive(), .meaning = "mass per volume"}}};
}

Section gravity_section() {
  return {"gravity",
          "[gravity]",
          "The weight of the shell: the load density times thickness times acceleration per area of the mid-surface, "
          "by region.",
          {{.name = "acceleration",
            .kind = Kind::vector,
            .unit = "m/s^2",
            .required = true,
            .meaning = "Cartesian acceleration of free fall; needs a density in [shell] or in a [[region]]",
            .example = "[0, 0, -9.81]"}}};
}

}  // namespace

std::vector<Section> shell_sections() { return {shell_section(), region_section(), gravity_section()}; }

}  // namespace plastron::config
