// Reads [shell], [[region]] and [gravity]: the cross-sections of the shell, and its weight.
#include <plastron/config/sections.hpp>
#include <plastron/shell/material.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace plastron::config {

namespace {

using element::Formulation, element::Rotations, element::Tangency;
using energy::CrossSection;
using shell::Material;

Section shell_section() {
  return {
      "shell",
      "[shell]",
      "The material and the thickness. The material is E and nu, or lambda and mu, or the name of a [[material]].",
      {key("E", Kind::number, {.unit = "Pa", .range = Range::positive(), .example = "2.1e11"}, "Young's modulus"),
       key("nu", Kind::number, {.range = poisson_range, .example = "0.3"},
           "Poisson's ratio; nearer to -1 double precision does not suffice"),
       key("lambda", Kind::number, {.unit = "Pa", .example = "1.2e11"},
           "first Lame constant; 3 lambda + 2 mu > 0, and Poisson's ratio is at least -0.999"),
       key("mu", Kind::number, {.unit = "Pa", .range = Range::positive(), .example = "8e10"}, "shear modulus"),
       key("material", Kind::name, {.example = "\"carbon\""}, "a [[material]], in the place of E and nu"),
       key("expansion", Kind::number, {.unit = "1/K", .example = "1.2e-5"},
           "thermal expansion, strain per temperature, of an isotropic material; see [[temperature]]"),
       key("thickness", &CrossSection::thickness,
           {.unit = "m", .required = true, .range = Range::positive(), .example = "0.02"}, "the thickness e"),
       key("density", &CrossSection::density, {.unit = "kg/m^3", .range = Range::positive()},
           "mass per volume, for the weight of the shell, see [gravity], and for natural frequencies, see [modes]"),
       key("shear_correction", &Material::shear_correction, {.fallback = "1", .range = Range::positive(2)},
           "factor of the transverse shear energy: 1 as in the paper, or 5/6. Several layers without this key have "
           "5/6: their shear stiffness is then the one of equilibrium through the thickness"),
       key("formulation", &Tangency::formulation,
           {{"tangent", Formulation::tangent},
            {"penalised", Formulation::penalised},
            {"mixed", Formulation::mixed},
            {"classical", Formulation::classical}},
           {.fallback = "\"tangent\""},
           "method that keeps r . a3 = 0. tangent: two rotations at each node; penalised: a penalty; mixed: a "
           "multiplier; classical: covariant components"),
       key("rotations", &assembly::ShellDescription::rotations,
           {{"small", Rotations::small}, {"finite", Rotations::finite}}, {.fallback = "\"small\""},
           "small: Naghdi's linear model. finite: strains, gaps and equilibrium are those of the deformed shell, "
           "with directors of length 1; loads keep their directions unless they follow. For the tangent formulation"),
       key("objective", &assembly::ShellDescription::is_objective, {.fallback = "false"},
           "true: with finite rotations strains are those between interpolated surfaces, so that a rigid rotation of "
           "any "
           "size has none. false: between exact surfaces; degree 1 and 2 then feel large rotations of curved shells"),
       key("penalty", &Tangency::penalty, {.fallback = "0.1", .range = Range::positive(1)},
           "p of the penalised formulation; the penalty is E e^3 / p"),
       key("stabilisation", &Tangency::stabilisation, {.fallback = "1", .range = Range::positive()},
           "rho of the mixed formulation; the stabilisation is rho E e^3")}};
}

Section region_section() {
  return {"region",
          "[[region]]",
          "Thickness, elastic constants and density of one region of the domain; at least one of them is given. The "
          "others are those of [shell]. Where regions of different thickness meet, strains use the thickness of their "
          "own cell. The gap at a node uses the largest thickness.",
          {key("name", Kind::name, {.required = true, .example = "\"stiff\""},
               "a region of the domain that no other [[region]] names"),
           key("faces", Kind::table, {.shorthand = Kind::name_or_names},
               "of a CAD file: the faces of the region; also written as a name or a list of names"),
           key("thickness", &CrossSection::thickness, {.unit = "m", .range = Range::positive()}, "the thickness e"),
           key("E", Kind::number, {.unit = "Pa", .range = Range::positive()}, "Young's modulus, together with nu"),
           key("nu", Kind::number, {.range = poisson_range}, "Poisson's ratio, together with E"),
           key("lambda", Kind::number, {.unit = "Pa"}, "first Lame constant, together with mu"),
           key("mu", Kind::number, {.unit = "Pa", .range = Range::positive()}, "shear modulus, together with lambda"),
           key("material", Kind::name, {}, "a [[material]], in the place of E and nu"),
           key("expansion", Kind::number, {.unit = "1/K"}, "thermal expansion of an isotropic material"),
           key("density", &CrossSection::density, {.unit = "kg/m^3", .range = Range::positive()}, "mass per volume")}};
}

Section gravity_section() {
  return {
      "gravity",
      "[gravity]",
      "The weight of the shell: in each region a load of density times thickness times acceleration, per area of the "
      "mid-surface.",
      {key("acceleration", &energy::Loads::gravity, {.unit = "m/s^2", .required = true, .example = "[0, 0, -9.81]"},
           "Cartesian acceleration of gravity; it needs a density in [shell] or in a [[region]]"),
       key("name", Kind::name, {}, "a name for step.factors")}};
}

constexpr const char* pairs = "either E and nu, or lambda and mu, or material";

void from_young_poisson(Table& table, Material& material) {
  for (const char* name : {"lambda", "mu"})
    if (table.has(name)) {
      table.report_key(name, fmt::format("\"{}\" is one constant too many", name), pairs);
      return;
    }
  const auto E = table.number("E"), nu = table.number("nu");
  if (E && nu) material.law = Material::from_young_poisson(*E, *nu, 1).law;
}

/// Returns the expansion of an isotropic material, 0 for others.
double expansion_of(const Material& material) { return material.isotropic() ? material.isotropic()->expansion : 0; }

void from_lame(Table& table, Material& material) {
  const auto lambda = table.number("lambda"), mu = table.number("mu");
  if (!lambda || !mu) return;
  if (3 * *lambda + 2 * *mu <= 0)
    return table.report("lambda",
                        fmt::format("lambda is {} and mu is {}: such a material expands under pressure", *lambda, *mu),
                        "3 lambda + 2 mu > 0");
  const double nu = *lambda / (2 * (*lambda + *mu));
  if (nu < poisson_range.low)
    return table.report("lambda", fmt::format("lambda is {} and mu is {}: Poisson's ratio is {:.6g}", *lambda, *mu, nu),
                        "lambda / (2 (lambda + mu)) >= -0.999", "nearer to -1 double precision does not suffice");
  material.law = shell::Isotropic{*lambda, *mu};
}

bool has_elastic_constants(const Table& table) {
  return std::ranges::any_of(std::array{"E", "nu", "lambda", "mu", "material"},
                             [&](const char* name) { return table.has(name); });
}

/// Reports the missing partner in a pair of elastic constants.
bool has_pair(const Table& table, const std::string& header, const char* first, const char* second) {
  if (table.has(first) && table.has(second)) return true;
  const char *given = table.has(first) ? first : second, *missing = table.has(first) ? second : first;
  table.report_key(given, fmt::format("{} has {} but no {}", header, given, missing), pairs);
  return false;
}

/// Sets the law of the [[material]] that the table names.
void from_name(Table& table, Material& material) {
  for (const char* name : {"E", "nu", "lambda", "mu"})
    if (table.has(name)) table.report_key(name, fmt::format("\"{}\" is given besides \"material\"", name), pairs);
  const auto name = table.text("material");
  if (!name) return;
  const auto& materials = table.reading().materials;
  const auto found = materials.find(*name);
  if (found == materials.end())
    report_unknown_material(table, *name);
  else if (found->second)
    material.law = found->second->material.law;
}

/// Sets the law from the table, if it is present and correct. `header`: name of the table in messages.
void read_material(Table& table, const std::string& header, Material& material) {
  double expansion = expansion_of(material);
  if (table.has("material")) {
    from_name(table, material);
    expansion = expansion_of(material);
  } else if (table.has("E") || table.has("nu")) {
    if (has_pair(table, header, "E", "nu")) from_young_poisson(table, material);
  } else if (table.has("lambda") || table.has("mu")) {
    if (has_pair(table, header, "lambda", "mu")) from_lame(table, material);
  }
  if (table.has("expansion")) {
    if (table.has("material") || !material.isotropic())
      table.report_key("expansion", fmt::format("{} has an expansion besides a [[material]]", header), "",
                       "give the [[material]] its expansion");
    expansion = table.number("expansion").value_or(0);
  }
  if (auto* isotropic = std::get_if<shell::Isotropic>(&material.law)) isotropic->expansion = expansion;
}

/// Sets the shear correction where [shell] does not give it. A section of several layers has no factor of its own.
void choose_shear_correction(const Table& root, Material& material) {
  const std::optional<toml::value> shell = root.value("shell");
  if (shell && shell->is_table() && shell->as_table().count("shear_correction") > 0) return;
  const auto laminate = material.laminate();
  material.shear_correction = laminate && laminate->layers().size() > 1 ? 5.0 / 6 : Material{}.shear_correction;
}

/// Reads a cross-section of a region. Its initial values are the values of [shell].
void read_own(Table& region, CrossSection& section) {
  if (!has_elastic_constants(region) && !region.has("thickness") && !region.has("density") &&
      !region.has("expansion") && !region.has("faces"))
    region.report_here("[[region]] has nothing of its own",
                       "thickness, E and nu, lambda and mu, material, expansion, density; faces of a CAD file",
                       "give one of them, or leave the region out: it is like [shell] anyway");
  read_material(region, "[[region]]", section.material);
  region.fill(section);
}

/// Returns the place of the first density in the file.
std::optional<Place> density_place(const Table& root) {
  std::vector<toml::value> tables;
  if (root.has("shell")) tables.push_back(root.value("shell").value());
  if (const toml::value regions = root.value("region").value(); regions.is_array())
    std::ranges::copy(regions.as_array(), std::back_inserter(tables));
  for (const toml::value& table : tables)
    if (table.is_table() && table.as_table().count("density") > 0)
      return root.reading().source.key("density", table.as_table().at("density"));
  return {};
}

/// Returns the largest change of the factor of a body's prescribed motions from one instant to the next.
double largest_part_of_motions(const problem::Problem& problem, const fem::RigidBody& body) {
  if (problem.steps.empty()) return 1;
  double before = 0, most = 0;
  for (const problem::Step& step : problem.steps) {
    const double part = step.chooses_parts ? problem::Step::longest_chosen_part : 1.0 / step.parts;
    const double factor = step.factors.support(body.factor);
    most = std::max(most, part * std::abs(factor - (problem.steps_are_cases ? 0 : before)));
    before = factor;
  }
  return most;
}

}  // namespace

std::vector<Section> shell_sections() { return {shell_section(), region_section(), gravity_section()}; }

void read_shell(Table& root, problem::Problem& problem) {
  root.in_table("shell", [&](Table& shell) {
    CrossSection& section = problem.shell.sections.common;
    shell.fill(section.material);
    if (!has_elastic_constants(shell))
      shell.report_here("[shell] has no elastic constants", pairs, "add E = 2.1e11 and nu = 0.3");
    read_material(shell, "[shell]", section.material);
    shell.fill(section);
    shell.fill(problem.shell.tangency);
    shell.fill(problem.shell);
    choose_shear_correction(root, section.material);
  });
}

void check_rotations(Table& root, const problem::Problem& problem) {
  if (problem.shell.rotations == Rotations::small && !problem.shell.is_objective) return;
  root.in_table("shell", [&](Table& shell) {
    if (problem.shell.rotations == Rotations::small)
      return shell.report("objective", "objective has no effect with small rotations", "",
                          "write rotations = \"finite\", or remove it");
    const Formulation formulation = problem.shell.tangency.formulation;
    if (formulation != Formulation::tangent)
      shell.report("rotations",
                   fmt::format("the {} formulation has no finite rotations", element::to_string(formulation)), "",
                   "write formulation = \"tangent\", or rotations = \"small\"");
    for (const fem::RigidBody& body : problem.rigid_bodies) {
      const double part = largest_part_of_motions(problem, body);
      const auto given =
          std::count_if(body.fixed.begin() + 3, body.fixed.end(), [](const auto& v) { return v.has_value(); });
      double largest_factor = problem.steps.empty() ? 1 : 0;
      for (const problem::Step& step : problem.steps)
        largest_factor = std::max(largest_factor, std::abs(step.factors.support(body.factor)));
      if (given < 3 && largest_factor * body.prescribed_rotation().norm() >= 2 * std::numbers::pi)
        shell.report(
            "rotations",
            fmt::format("the rigid body \"{}\" is to turn by a whole turn, and a part of theta is free", body.name), "",
            "fix all of theta");
      if (part * body.prescribed_rotation().norm() >= std::numbers::pi)
        shell.report("rotations",
                     fmt::format("the rigid body \"{}\" is to turn by half a turn or more at once", body.name),
                     "less than pi in each part of a step", "write a [[step]] with parts = 8");
    }
    if (problem.shell.obstacles.are_linear)
      shell.report("rotations",
                   "with finite rotations gaps are those of the deformed shell, and [contact] wants them linearised",
                   "", "remove linearised = true, or write rotations = \"small\"");
  });
}

void read_regions(Table& root, problem::Problem& problem) {
  root.in_tables("region", [&](Table& region) {
    const auto name = region.known_name("name", "region", root.reading().regions());
    CrossSection section = problem.shell.sections.common;
    read_faces_of_region(region, name);
    read_own(region, section);
    choose_shear_correction(root, section.material);
    if (name && !problem.shell.sections.regions.emplace(*name, std::move(section)).second)
      region.report("name", fmt::format("two [[region]] are named \"{}\"", *name), "",
                    "write all that it has in one of them");
  });
}

void read_gravity(Table& root, problem::Problem& problem) {
  if (!root.has("gravity")) return;
  if (!density_place(root))
    root.report_key("gravity", "[gravity] has nothing to pull at: no density is given", "",
                    "add density = 7850 to [shell] or to a [[region]]");
  root.in_table("gravity", [&](Table& gravity) {
    gravity.fill(problem.shell.loads);
    problem.shell.loads.gravity_factor = read_factor_name(gravity, problem);
  });
}

}  // namespace plastron::config
