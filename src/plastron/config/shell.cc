// Reads [shell].
#include <plastron/config/material.hpp>
#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

void read_tangency(Table& shell, element::Tangency& tangency) {
  using element::Formulation;
  static const std::map<std::string, Formulation> formulations{{"tangent", Formulation::tangent},
                                                               {"penalised", Formulation::penalised},
                                                               {"mixed", Formulation::mixed},
                                                               {"classical", Formulation::classical}};
  if (const auto name = shell.text("formulation")) tangency.formulation = formulations.at(*name);
  if (const auto p = shell.number("penalty")) tangency.penalty = *p;
  if (const auto rho = shell.number("stabilisation")) tangency.stabilisation = *rho;
}

}  // namespace

void read_shell(Table& root, problem::Problem& problem) {
  auto shell = root.table("shell");
  if (!shell) return;
  const auto shear_correction = shell->number("shear_correction");
  assembly::CrossSection& section = problem.shell.sections.common;
  section.material.shear_correction = shear_correction.value_or(1);
  if (!has_elastic_constants(*shell))
    shell->reading().report(shell->place(), "[shell] has no elastic constants", "either E and nu, or lambda and mu",
                            "add E = 2.1e11 and nu = 0.3");
  read_material(*shell, "[shell]", section.material);
  if (const auto thickness = shell->field("thickness")) section.thickness = *thickness;
  if (const auto density = shell->number("density")) section.density = *density;
  read_tangency(*shell, problem.shell.tangency);
  root.effective["shell"] = shell->effective;
}

}  // namespace plastron::config
