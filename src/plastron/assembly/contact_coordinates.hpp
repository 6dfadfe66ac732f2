// Coordinates of a node in which the gaps of several obstacles are coordinates themselves (D4).
#pragma once
#include <plastron/obstacle/gap.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace plastron::assembly {

using geometry::Vector3d;

struct ContactColumn {
  Vector3d u = Vector3d::Zero(), r = Vector3d::Zero();
};

/// Where an obstacle's gap stands among the coordinates: its change is scale times that of the coordinate.
struct ContactPlace {
  int coordinate = -1;  ///< -1: the free directions do not change it
  double scale = 1;
};

struct ContactCoordinates {
  std::vector<ContactColumn> columns{};  ///< a basis of the free directions, coordinates of gaps first
  std::vector<ContactPlace> places{};    ///< of each gap
};

/// Two unit vectors that make an orthonormal basis with the unit vector n.
std::array<Vector3d, 2> across(const Vector3d& n);

/// `u`, `r`: orthonormal bases of the displacements and rotations that supports leave free. Nothing where a gap depends on
/// several others: no coordinates have bounds for all of them.
std::optional<ContactCoordinates> contact_coordinates(std::span<const obstacle::Gap> gaps,
                                                      const std::vector<Vector3d>& u, const std::vector<Vector3d>& r);

}  // namespace plastron::assembly
