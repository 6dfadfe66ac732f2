// Small problems from which tests build others.
#pragma once
#include <plastron/problem/problem.hpp>

#include <string>
#include <vector>

namespace plastron::test {

using assembly::Direction;
using assembly::PrescribedComponent;
using assembly::Support;
using assembly::Unknown;
using geometry::Chart;
using geometry::Constants;
using geometry::Expression;
using problem::Problem;

inline PrescribedComponent fixed(Unknown unknown, Direction direction, const Expression& value = {}) {
  return {unknown, direction, value};
}

/// u = r = 0.
inline Support clamped(const std::string& boundary) {
  Support s{.boundary = boundary, .components = {}};
  for (const Unknown unknown : {Unknown::displacement, Unknown::rotation})
    for (const Direction d : {Direction::x, Direction::y, Direction::z}) s.components.push_back(fixed(unknown, d));
  return s;
}

/// Some components of u.
inline Support held(const std::string& boundary, const std::vector<Direction>& directions) {
  Support s{.boundary = boundary, .components = {}};
  for (const Direction d : directions) s.components.push_back(fixed(Unknown::displacement, d));
  return s;
}

inline Support symmetry(const std::string& boundary) {
  return {
      .boundary = boundary,
      .components = {fixed(Unknown::displacement, Direction::conormal), fixed(Unknown::rotation, Direction::conormal)},
      .symmetry = true};
}

/// Keeps a strip along x in its plane.
inline Support in_plane(const std::string& boundary) {
  return {.boundary = boundary,
          .components = {fixed(Unknown::displacement, Direction::y), fixed(Unknown::rotation, Direction::y)}};
}

inline energy::VectorExpression vector(double x, double y, double z) {
  return {Expression(x), Expression(y), Expression(z)};
}

inline energy::AreaLoad force(double x, double y, double z) {
  energy::AreaLoad load;
  load.force = vector(x, y, z);
  return load;
}

/// A flat square of side 1 in the plane z = 0, without supports and loads.
inline Problem free_plate() {
  Problem p;
  p.domain = domain::Rectangle{.cells = {2, 2}};
  p.charts.emplace("", Chart({"x", "y", "0"}, {}));
  p.shell.sections.common.thickness = Expression(0.1);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1e4, 0.3, 1);
  p.discretisation = {.degree = 2, .refinements = 1};
  return p;
}

inline Problem with_chart(Problem p, const std::array<std::string, 3>& chart, const Constants& constants = {}) {
  p.charts.clear();
  p.charts.emplace("", Chart(chart, constants));
  return p;
}

/// The square clamped at x = 0 under its weight.
inline Problem cantilever_plate() {
  Problem p = free_plate();
  p.shell.supports = {clamped("left")};
  p.shell.loads.on_areas = {force(0, 0, -1)};
  return p;
}

/// A strip 0.01 above the table z = 0, clamped at both ends and pressed on it.
inline Problem pressed_strip() {
  Problem p = with_chart(free_plate(), {"x", "y", "0.01 + e/2"}, {{"e", 0.05}});
  p.domain = domain::Rectangle{.to = {1, 0.125}, .cells = {8, 1}};
  p.shell.sections.common.thickness = Expression(0.05);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("left"), clamped("right"), in_plane("bottom"), in_plane("top")};
  p.shell.loads.on_areas = {force(0, 0, -4e-3)};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  return p;
}

/// A spherical bowl over the table z = 0, clamped at its rim and pressed on it.
inline Problem pressed_bowl() {
  Problem p = with_chart(free_plate(), {"x", "y", "clearance + e/2 + R - sqrt(R^2 - x^2 - y^2)"},
                         {{"R", 1}, {"e", 0.02}, {"clearance", 0.01}});
  p.domain = domain::Disk{.radius = 0.479425538604203};
  p.shell.sections.common.thickness = Expression(0.02);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.shell.supports = {clamped("rim")};
  p.shell.loads.on_areas = {force(0, 0, -2e-3)};
  p.shell.obstacles.all = {obstacle::Obstacle{}};
  return p;
}

}  // namespace plastron::test
