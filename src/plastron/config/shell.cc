#include <plastron/config/sections.hpp>

namespace plastron::config {

namespace {

std::optional<shell::Material> from_young_poisson(Table& shell, double shear_correction) {
  for (const char* name : {"lambda", "mu"})
    if (shell.has(name)) {
      shell.reading().report(shell.key_place(name), fmt::format("\"{}\" is one constant too many", name),
                             "either E and nu, or lambda and mu");
      return {};
    }
  const auto E = shell.number("E"), nu = shell.number("nu");
  if (!E || !nu) return {};
  return shell::Material::from_young_poisson(*E, *nu, shear_correction);
}

std::optional<shell::Material> from_lame(Table& shell, double shear_correction) {
  const auto lambda = shell.number("lambda"), mu = shell.number("mu");
  if (!lambda || !mu) return {};
  if (3 * *lambda + 2 * *mu <= 0) {
    shell.report("lambda",
                 fmt::format("lambda is {} and mu is {}: such a material expands under pressure", *lambda, *mu),
                 "3 lambda + 2 mu > 0");
    return {};
  }
  const double nu = *lambda / (2 * (*lambda + *mu));
  if (nu < -0.999) {
    shell.report("lambda", fmt::format("lambda is {} and mu is {}: Poisson's ratio is {:.6g}", *lambda, *mu, nu),
                 "lambda / (2 (lambda + mu)) >= -0.999", "nearer to -1 double precision does not suffice");
    return {};
  }
  return shell::Material{*lambda, *mu, shear_correction};
}

// Reports the partner that is missing from a pair of elastic constants.
bool has_pair(const Table& shell, const char* first, const char* second) {
  if (shell.has(first) && shell.has(second)) return true;
  const char *given = shell.has(first) ? first : second, *missing = shell.has(first) ? second : first;
  shell.reading().report(shell.key_place(given), fmt::format("[shell] has {} but no {}", given, missing),
                         "either E and nu, or lambda and mu");
  return false;
}

std::optional<shell::Material> read_material(Table& shell, double shear_correction) {
  if (shell.has("E") || shell.has("nu"))
    return has_pair(shell, "E", "nu") ? from_young_poisson(shell, shear_correction) : std::nullopt;
  if (shell.has("lambda") || shell.has("mu"))
    return has_pair(shell, "lambda", "mu") ? from_lame(shell, shear_correction) : std::nullopt;
  shell.reading().report(shell.place(), "[shell] has no elastic constants", "either E and nu, or lambda and mu",
                         "add E = 2.1e11 and nu = 0.3");
  return {};
}

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

void read_shell(Table& root, computation::Problem& problem) {
  auto shell = root.table("shell");
  if (!shell) return;
  const auto shear_correction = shell->number("shear_correction");
  if (const auto material = read_material(*shell, shear_correction.value_or(1))) problem.material = *material;
  if (const auto thickness = shell->field("thickness")) problem.thickness = *thickness;
  read_tangency(*shell, problem.discretisation.tangency);
  root.effective["shell"] = shell->effective;
}

}  // namespace plastron::config
