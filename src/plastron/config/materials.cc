// Reads [[material]]: materials with a name, which [shell] and [[region]] choose.
#include <plastron/config/nearest.hpp>
#include <plastron/config/sections.hpp>

#include <array>
#include <numbers>
#include <span>

namespace plastron::config {

namespace {

using shell::Layer, shell::Material, shell::Orthotropic;

constexpr std::array isotropic_keys{"E", "nu", "expansion"};
constexpr std::array orthotropic_keys{"E1", "E2", "nu12", "G12", "G13", "G23", "expansion1", "expansion2"};
constexpr const char* ways = "E and nu, or E1, E2, nu12, G12, G13 and G23, or layers";

Section material_section() {
  const auto modulus = [](const char* name, double Orthotropic::*member, const char* meaning) {
    return key(name, member, {.unit = "Pa", .range = Range::positive()}, meaning);
  };
  return {
      "material",
      "[[material]]",
      "A material with a name, which [shell] and [[region]] choose by `material`. It is isotropic (E and nu), "
      "orthotropic (E1, E2, nu12, G12, G13, G23), or a laminate of layers. Axis 1 of an orthotropic material and of a "
      "laminate is the projection of `direction` on the tangent plane; axis 2 is a3 x axis 1.",
      {key("name", Kind::name, {.required = true, .example = "\"carbon\""}, "a name that no other [[material]] has"),
       key("E", Kind::number, {.unit = "Pa", .range = Range::positive()}, "Young's modulus, isotropic"),
       key("nu", Kind::number, {.range = poisson_range}, "Poisson's ratio, isotropic"),
       modulus("E1", &Orthotropic::E1, "Young's modulus along axis 1"),
       modulus("E2", &Orthotropic::E2, "Young's modulus along axis 2"),
       key("nu12", &Orthotropic::nu12, {},
           "Poisson's ratio: contraction along axis 2 by a stress along axis 1; nu12^2 < E1 / E2"),
       modulus("G12", &Orthotropic::G12, "shear modulus in the tangent plane"),
       modulus("G13", &Orthotropic::G13, "modulus of transverse shear along axis 1"),
       modulus("G23", &Orthotropic::G23, "modulus of transverse shear along axis 2"),
       key("expansion", Kind::number, {.unit = "1/K"}, "thermal expansion, isotropic; see [[temperature]]"),
       key("expansion1", &Orthotropic::expansion1, {.unit = "1/K"}, "thermal expansion along axis 1; 0 if not given"),
       key("expansion2", &Orthotropic::expansion2, {.unit = "1/K"}, "thermal expansion along axis 2; 0 if not given"),
       key("direction", Kind::vector, {.fallback = "[1, 0, 0]"},
           "a direction in space; nowhere normal to the shell. Not for isotropic materials"),
       key("layers", Kind::tables, {.fallback = "[]"}, "the layers of a laminate, from the lower to the upper face")}};
}

Section layer_section() {
  return {
      "material.layers",
      "[[material.layers]]",
      "A layer of a laminate. The first lies at the lower face. Together the layers fill the thickness of the shell. "
      "Their position follows from their order: the mid-surface is in the middle of all layers.",
      {key("material", Kind::name, {.required = true, .example = "\"carbon\""},
           "a [[material]] above this one that has no layers; its own direction does not count here"),
       key("thickness", &Layer::part, {.required = true, .range = Range::positive(), .example = "1"},
           "the layer's part of the thickness: only its ratio to the other layers' counts, so that lengths will do"),
       key("angle", Kind::number, {.unit = "degrees", .fallback = "0", .range = Range::between(-360, 360)},
           "angle from the laminate's axis 1 to the layer's axis 1, positive from axis 1 to axis 2"),
       key("strain", &Layer::strain, {.fallback = "[0, 0, 0]"},
           "initial strains eps_1, eps_2 and 2 eps_12 in the layer's axes, free of stress, for example thermal. They "
           "are a load: steps multiply them by `loads`")}};
}

bool is_orthotropic(const Table& table) {
  return std::ranges::any_of(orthotropic_keys, [&](const char* name) { return table.has(name); });
}

/// Reports keys that belong to another kind of material.
void report_others(const Table& table, std::span<const char* const> names) {
  for (const char* name : names)
    if (table.has(name))
      table.report_key(name, fmt::format("[[material]] has \"{}\" besides the constants of another kind", name), ways);
}

std::optional<NamedMaterial> isotropic(Table& table) {
  for (const char* name : {"E", "nu"})
    if (!table.has(name)) table.report_here(fmt::format("[[material]] is isotropic, but has no \"{}\"", name), ways);
  report_others(table, orthotropic_keys);
  if (table.has("direction")) table.report_key("direction", "an isotropic material has no direction");
  const auto E = table.number("E"), nu = table.number("nu");
  const double expansion = table.has("expansion") ? table.number("expansion").value_or(0) : 0;
  if (!E || !nu) return {};
  Material material = Material::from_young_poisson(*E, *nu, 1);
  std::get<shell::Isotropic>(material.law).expansion = expansion;
  return NamedMaterial{.material = material, .layer = Orthotropic::isotropic(*E, *nu, expansion)};
}

std::optional<Orthotropic> orthotropic_constants(Table& table) {
  Orthotropic m;
  bool complete = table.fill(m);
  for (const char* name : {"E1", "E2", "nu12", "G12", "G13", "G23"})
    if (!table.has(name)) {
      table.report_here(fmt::format("[[material]] is orthotropic, but has no \"{}\"", name), ways,
                        "where the moduli of transverse shear are not known, G13 = G23 = G12 is a common choice");
      complete = false;
    }
  if (!complete) return {};
  if (m.is_positive_definite()) return m;
  table.report("nu12",
               fmt::format("nu12 is {}, E1 is {} and E2 is {}: such a material gives energy when it is stretched",
                           m.nu12, m.E1, m.E2),
               fmt::format("nu12^2 < E1 / E2 = {:.6g}", m.E1 / m.E2),
               "nu12 is the contraction along axis 2; for the other one, nu12 = nu21 E1 / E2");
  return {};
}

/// Returns the material that the layer names.
std::optional<Orthotropic> layer_material(Table& table) {
  const auto name = table.text("material");
  if (!name) return {};
  const auto& materials = table.reading().materials;
  const auto found = materials.find(*name);
  if (found == materials.end()) {
    report_unknown_material(table, *name);
  } else if (found->second && !found->second->layer) {
    table.report("material", fmt::format("the material \"{}\" has layers itself", *name), "a material without layers");
  } else if (found->second) {
    return found->second->layer;
  }
  return {};
}

std::vector<Layer> layers_of(Table& material) {
  std::vector<Layer> layers;
  material.in_tables("layers", [&](Table& table) {
    Layer layer;
    const bool is_complete = table.fill(layer);
    const auto angle = table.number("angle");
    const auto constants = layer_material(table);
    if (!is_complete || !angle || !constants) return;
    layer.angle = *angle * std::numbers::pi / 180;
    layer.material = *constants;
    layers.push_back(layer);
  });
  return layers;
}

std::optional<NamedMaterial> laminate(Table& table) {
  report_others(table, isotropic_keys);
  report_others(table, orthotropic_keys);
  const auto direction = table.direction("direction");
  auto layers = layers_of(table);
  if (table.value("layers")->is_array() && table.value("layers")->as_array().empty())
    table.report("layers", "a laminate without layers", "at least one layer");
  if (layers.empty() || !direction) return {};
  return NamedMaterial{.material = {.law = std::make_shared<const shell::Laminate>(std::move(layers), *direction)}};
}

std::optional<NamedMaterial> orthotropic(Table& table) {
  report_others(table, isotropic_keys);
  const auto direction = table.direction("direction");
  const auto constants = orthotropic_constants(table);
  if (!direction || !constants) return {};
  return NamedMaterial{.material = {.law = std::make_shared<const shell::Laminate>(
                                        std::vector{Layer{.material = *constants}}, *direction)},
                       .layer = *constants};
}

std::optional<NamedMaterial> material_of(Table& table) {
  if (table.has("layers")) return laminate(table);
  if (is_orthotropic(table)) return orthotropic(table);
  if (table.has("E") || table.has("nu")) return isotropic(table);
  table.report_here("[[material]] has no elastic constants", ways);
  return {};
}

}  // namespace

std::vector<Section> material_sections() { return {material_section(), layer_section()}; }

void report_unknown_material(const Table& table, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& [other, material] : table.reading().materials) known.push_back(other);
  table.report("material", fmt::format("no [[material]] above has the name \"{}\"", name),
               known.empty() ? "" : joined(known),
               known.empty() ? "add a section [[material]]" : did_you_mean(name, known));
}

void read_materials(Table& root) {
  root.in_tables("material", [&](Table& table) {
    const auto name = table.text("name");
    auto material = material_of(table);
    if (!name) return;
    if (!table.reading().materials.emplace(*name, std::move(material)).second)
      table.report("name", fmt::format("two [[material]] are named \"{}\"", *name), "", "give each a name of its own");
  });
}

}  // namespace plastron::config
