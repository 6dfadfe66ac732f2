// The problems of the benchmarks, pressed on a table: a spherical cap, a clamped strip, a barrel panel between two walls.
#pragma once
#include <plastron/problem/problem.hpp>

#include <array>
#include <cmath>
#include <string>

namespace plastron::benchmarks {

inline assembly::PrescribedComponent fixed(assembly::Unknown unknown, assembly::Direction direction) {
  return {unknown, direction, {}};
}

inline assembly::Support clamped(const std::string& boundary) {
  assembly::Support support{.boundary = boundary, .components = {}};
  for (const auto unknown : {assembly::Unknown::displacement, assembly::Unknown::rotation})
    for (const auto direction : {assembly::Direction::x, assembly::Direction::y, assembly::Direction::z})
      support.components.push_back(fixed(unknown, direction));
  return support;
}

inline problem::Problem pressed(double load) {
  problem::Problem problem;
  problem.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  energy::AreaLoad weight;
  weight.force[2] = geometry::Expression(-load);
  problem.shell.loads.on_areas = {weight};
  problem.shell.obstacles.all = {obstacle::Obstacle{}};
  return problem;
}

/// Radius 1, half angle 0.5, rim clamped, bottom 0.01 above the table. The load grows like e^1.4, which keeps the patch's
/// size about the same from thick to thin; e = 0.1 and 0.02 have the loads of the references R4cap.
inline problem::Problem cap(double e, int degree, int refinements) {
  const double load = 0.02 * std::pow(e / 0.1, std::log(10.0) / std::log(5.0));
  problem::Problem problem = pressed(load);
  problem.domain = domain::Disk{.radius = std::sin(0.5)};
  const geometry::Constants constants{{"z0", 1 + e / 2 + 0.01}};
  problem.charts.emplace("", geometry::Chart({"x", "y", "z0 - sqrt(1 - x^2 - y^2)"}, constants));
  problem.shell.sections.common.thickness = geometry::Expression(e);
  problem.shell.supports = {clamped("rim")};
  problem.discretisation = {.degree = degree, .refinements = refinements};
  return problem;
}

/// An edge in a plane of symmetry with this normal.
inline assembly::Support mirrored(const std::string& boundary, assembly::Direction normal) {
  return {.boundary = boundary,
          .components = {fixed(assembly::Unknown::displacement, normal), fixed(assembly::Unknown::rotation, normal)}};
}

/// A quarter of radius 1, arc and length 0.5, e = 0.02: two edges of symmetry, one in the wall, one free; 0.01 above the table (cases/barrel-panel).
inline problem::Problem barrel(int degree, int refinements) {
  constexpr double e = 0.02;
  problem::Problem problem = pressed(8e-4);
  problem.domain = domain::Rectangle{.to = {0.5, 0.5}, .cells = {9, 9}};
  problem.charts.emplace("", geometry::Chart({"sin(x)", "y", "z0 - cos(x)"}, {{"z0", 1 + e / 2 + 0.01}}));
  problem.shell.sections.common.thickness = geometry::Expression(e);
  problem.shell.supports = {mirrored("left", assembly::Direction::x), mirrored("bottom", assembly::Direction::y),
                            clamped("right")};
  problem.discretisation = {.degree = degree, .refinements = refinements};
  return problem;
}

/// Length 1, both ends clamped, 0.01 above the table; load 3 e^3 as in the references R1.
inline problem::Problem strip(double e, int degree, int refinements, std::array<int, 2> cells = {4, 1}) {
  problem::Problem problem = pressed(3 * e * e * e);
  problem.domain = domain::Rectangle{.to = {1, 0.25}, .cells = cells};
  problem.charts.emplace("", geometry::Chart({"x", "y", "z0"}, {{"z0", e / 2 + 0.01}}));
  problem.shell.sections.common.thickness = geometry::Expression(e);
  problem.shell.supports = {clamped("left"), clamped("right")};
  for (const char* side : {"bottom", "top"}) problem.shell.supports.push_back(mirrored(side, assembly::Direction::y));
  problem.discretisation = {.degree = degree, .refinements = refinements};
  return problem;
}

}  // namespace plastron::benchmarks
