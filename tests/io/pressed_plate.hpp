// A small solved problem: a clamped plate pressed on a plane, over parameters that are not lengths.
#pragma once
#include <plastron/computation/solve.hpp>

namespace plastron::io {

struct PressedPlate {
  int degree = 2;
  int cells = 2;  ///< along a side of the coarsest mesh
  int refinements = 1;
  bool obstacle = true;
  mesh::Shape shape = mesh::Shape::quadrilateral;
};

/// phi = (2x, y, 0.012) on the unit square, thickness 0.02: the lower face hangs 0.002 over the plane z = 0.
problem::Problem pressed_plate(const PressedPlate& options);

}  // namespace plastron::io
