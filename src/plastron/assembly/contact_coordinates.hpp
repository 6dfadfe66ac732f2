// Coordinates of a node in which the gaps of several obstacles are coordinates themselves (D4).
#pragma once
#include <plastron/obstacle/gap.hpp>

#include <array>
#include <span>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct ContactColumn {
  Vector3d u = Vector3d::Zero(), r = Vector3d::Zero();
};

/// Place of an obstacle's gap among the coordinates. The gap changes by scale times the change of the coordinate.
struct ContactPlace {
  int coordinate = -1;  ///< -1: the free directions do not change the gap, or it is left out
  double scale = 1;
  /// The gap depends on nearer gaps and has no bound: it is nearly a combination of several, or that of the far face.
  bool is_left_out = false;
  /// The gap is that of the other face, between the shell and an obstacle on its other side. It also changes with other
  /// coordinates, by the slope of the shell, which its bound does not contain.
  bool is_approximate = false;
};

struct ContactCoordinates {
  std::vector<ContactColumn> columns{};  ///< basis of the free directions; coordinates of gaps are first
  std::vector<ContactPlace> places{};    ///< one for each gap
};

/// Returns two unit vectors that are normal to n and to each other.
std::array<Vector3d, 2> across(const Vector3d& n);

/// Returns the coordinates of a node. `u`, `r`: orthonormal bases of the displacements and rotations that supports
/// leave free. `order`: the gaps, the most important first. This order is used only where some gaps must be left out or have
/// an approximate bound. Elsewhere the gaps keep their given order.
ContactCoordinates contact_coordinates(std::span<const obstacle::Gap> gaps, std::span<const std::size_t> order,
                                       const std::vector<Vector3d>& u, const std::vector<Vector3d>& r);

}  // namespace plastron::assembly
