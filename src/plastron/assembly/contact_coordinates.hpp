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

/// Where an obstacle's gap stands among the coordinates: its change is scale times that of the coordinate.
struct ContactPlace {
  int coordinate = -1;  ///< -1: the free directions do not change it, or it is left out
  double scale = 1;
  bool is_left_out = false;  ///< it depends on several gaps that are nearer: no coordinates have bounds for all of them
};

struct ContactCoordinates {
  std::vector<ContactColumn> columns{};  ///< a basis of the free directions, coordinates of gaps first
  std::vector<ContactPlace> places{};    ///< of each gap
};

/// Two unit vectors that make an orthonormal basis with the unit vector n.
std::array<Vector3d, 2> across(const Vector3d& n);

/// `u`, `r`: orthonormal bases of the displacements and rotations that supports leave free; `order`: of the gaps, the one that matters
/// most first. It decides only where some must be left out: elsewhere the gaps' own order does.
ContactCoordinates contact_coordinates(std::span<const obstacle::Gap> gaps, std::span<const std::size_t> order,
                                       const std::vector<Vector3d>& u, const std::vector<Vector3d>& r);

}  // namespace plastron::assembly
