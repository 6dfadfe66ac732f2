// Shells with E = 1, nu = 0.3, k_s = 1 on uniform meshes of degree 4: disks, strips and a ring, in the scenes of finite rotations.
#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "computation/problems.hpp"

namespace plastron::test {

/// Returns a shell with E = 1, nu = 0.3, k_s = 1 on uniform meshes of degree 4.
inline problem::Problem shell_of(const std::array<std::string, 3>& chart, double e, int refinements) {
  problem::Problem p = with_chart(free_plate(), chart, {{"e", e}});
  p.shell.sections.common.thickness = Expression(e);
  p.shell.sections.common.material = shell::Material::from_young_poisson(1, 0.3, 1);
  p.discretisation = {.degree = 4, .refinements = refinements};
  return p;
}

inline problem::Problem disk_of(const std::array<std::string, 3>& chart, double e, double radius, int refinements = 3) {
  problem::Problem p = shell_of(chart, e, refinements);
  p.domain = domain::Disk{.radius = radius};
  p.shell.supports = {clamped("rim")};
  return p;
}

inline problem::Problem strip_of(const std::array<std::string, 3>& chart, double e, double length, int refinements) {
  problem::Problem p = shell_of(chart, e, refinements);
  p.domain = domain::Rectangle{.to = {length, 0.1}, .cells = {10, 1}};
  p.shell.supports = {in_plane("bottom"), in_plane("top")};
  return p;
}

/// A quarter of a ring of radius 1 in plane strain, symmetric at both ends.
inline problem::Problem quarter_ring(double e, int refinements) {
  problem::Problem p = strip_of({"sin(x)", "y", "-cos(x)"}, e, std::numbers::pi / 2, refinements);
  p.shell.supports.push_back(
      {.boundary = "left",
       .components = {fixed(Unknown::displacement, Direction::x), fixed(Unknown::rotation, Direction::x)}});
  p.shell.supports.push_back(
      {.boundary = "right",
       .components = {fixed(Unknown::displacement, Direction::z), fixed(Unknown::rotation, Direction::z)}});
  return p;
}

inline obstacle::Obstacle table(double z, double n = 1) {
  return {.shape = obstacle::HalfSpace{.point = {0, 0, z}, .normal = {0, 0, n}},
          .face = n > 0 ? obstacle::Face::lower : obstacle::Face::upper};
}

}  // namespace plastron::test
