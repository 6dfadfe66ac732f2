#include <plastron/config/material.hpp>

#include <algorithm>
#include <array>

namespace plastron::config {

namespace {

using shell::Material;

void from_young_poisson(Table& table, Material& material) {
  for (const char* name : {"lambda", "mu"})
    if (table.has(name)) {
      table.reading().report(table.key_place(name), fmt::format("\"{}\" is one constant too many", name),
                             "either E and nu, or lambda and mu");
      return;
    }
  const auto E = table.number("E"), nu = table.number("nu");
  if (E && nu) material = Material::from_young_poisson(*E, *nu, material.shear_correction);
}

void from_lame(Table& table, Material& material) {
  const auto lambda = table.number("lambda"), mu = table.number("mu");
  if (!lambda || !mu) return;
  if (3 * *lambda + 2 * *mu <= 0)
    return table.report("lambda",
                        fmt::format("lambda is {} and mu is {}: such a material expands under pressure", *lambda, *mu),
                        "3 lambda + 2 mu > 0");
  const double nu = *lambda / (2 * (*lambda + *mu));
  if (nu < -0.999)
    return table.report("lambda", fmt::format("lambda is {} and mu is {}: Poisson's ratio is {:.6g}", *lambda, *mu, nu),
                        "lambda / (2 (lambda + mu)) >= -0.999", "nearer to -1 double precision does not suffice");
  material = {*lambda, *mu, material.shear_correction};
}

/// Reports the missing partner in a pair of elastic constants.
bool has_pair(const Table& table, const std::string& header, const char* first, const char* second) {
  if (table.has(first) && table.has(second)) return true;
  const char *given = table.has(first) ? first : second, *missing = table.has(first) ? second : first;
  table.reading().report(table.key_place(given), fmt::format("{} has {} but no {}", header, given, missing),
                         "either E and nu, or lambda and mu");
  return false;
}

}  // namespace

bool has_elastic_constants(const Table& table) {
  return std::ranges::any_of(std::array{"E", "nu", "lambda", "mu"}, [&](const char* name) { return table.has(name); });
}

void read_material(Table& table, const std::string& header, Material& material) {
  if (table.has("E") || table.has("nu")) {
    if (has_pair(table, header, "E", "nu")) from_young_poisson(table, material);
  } else if (table.has("lambda") || table.has("mu")) {
    if (has_pair(table, header, "lambda", "mu")) from_lame(table, material);
  }
}

}  // namespace plastron::config
