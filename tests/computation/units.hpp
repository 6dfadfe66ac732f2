// One small problem in other units: the numbers of its lengths and forces are multiplied, the shell stays the same.
#pragma once

#include "computation/problems.hpp"

namespace plastron::test {

/// Factors of the numbers of all lengths and of all forces. A modulus is then multiplied by force / length^2.
struct Units {
  double length = 1, force = 1;
};

/// A small curved panel above a table, supported at two sides. A pressure, a line load and a couple press it on the table.
inline Problem panel(const Units& units) {
  const double L = units.length, F = units.force, pressure = F / (L * L);
  Problem p = with_chart(free_plate(), {"x", "y", "0.02*L + e/2 + 0.2*x^2/L"}, {{"L", L}, {"e", 0.1 * L}});
  p.domain = domain::Rectangle{.to = {L, L}, .cells = {2, 2}};
  p.shell.sections.common.thickness = Expression(0.1 * L);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e4 * pressure, 0.3, 1);
  p.shell.supports = {clamped("left"), held("right", {Direction::x, Direction::y, Direction::z})};
  p.shell.loads.on_areas = {force(0, 0, -60 * pressure)};
  p.shell.loads.on_edges = {{.boundary = "top", .force = vector(0, 0, -3 * F / L), .couple = vector(0.1 * F, 0, 0)}};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  p.probes = {{.name = "middle", .at = {0.5 * L, 0.4 * L}}};
  p.discretisation = {.degree = 2, .refinements = 1};
  return p;
}

}  // namespace plastron::test
