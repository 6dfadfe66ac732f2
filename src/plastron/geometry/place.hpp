// Where expressions and given functions are evaluated.
#pragma once

namespace plastron::geometry {

/// A place on the undeformed mid-surface: its parameters in Omega and its Cartesian coordinates [m].
struct Place {
  double x = 0, y = 0;
  double X = 0, Y = 0, Z = 0;
};

}  // namespace plastron::geometry
