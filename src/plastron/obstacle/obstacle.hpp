// A rigid obstacle as a value: a shape in space, how it moves from step to step or what presses it, and the face of the shell that it
// meets.
#pragma once
#include <plastron/obstacle/ball.hpp>
#include <plastron/obstacle/box.hpp>
#include <plastron/obstacle/cone.hpp>
#include <plastron/obstacle/cylinder.hpp>
#include <plastron/obstacle/distance_field.hpp>
#include <plastron/obstacle/half_space.hpp>
#include <plastron/obstacle/height_field.hpp>
#include <plastron/obstacle/motion.hpp>
#include <plastron/obstacle/torus.hpp>
#include <plastron/obstacle/triangle_surface.hpp>

#include <string>
#include <variant>

namespace plastron::obstacle {

/// A face of the shell: the points phi -+ e/2 a_3. Nearer is, point by point, the one whose outward normal looks at the obstacle.
enum class Face { lower, upper, nearer };

/// Copies are cheap: what is large is shared and never changes.
using Shape = std::variant<HalfSpace, Ball, Cylinder, Box, Torus, Cone, HeightField, DistanceField, TriangleSurface>;

struct Obstacle {
  std::string name{};  ///< no two obstacles of a problem share one; may be empty where there is one obstacle only
  Shape shape = HalfSpace{};
  Face face = Face::nearer;           ///< of the shell, the one that may touch
  bool is_for_both = false;           ///< another obstacle is the same body for the other face: one of them may be far
  Placement placement{};              ///< where the shape stands, at time 0 if it moves
  std::vector<Motion> motions{};      ///< by step
  Vector3d force = Vector3d::Zero();  ///< that presses it along its direction, where it is not held [N]

  /// Its gap is linear in the displacements: nothing is to be linearised again.
  bool is_plane() const { return std::holds_alternative<HalfSpace>(shape); }
  /// A force presses it: how far it has come along that is found and not given.
  bool is_pressed() const { return !force.isZero(0); }
  /// The same body at rest where it stands at `time`, having come `position` [m] along its force.
  Obstacle standing(double time, double position = 0) const;
  /// "the obstacle", and its name if it has one.
  std::string text() const;
  /// Distance, normal and curvature at X of the body where its shape is placed. Throws ObstacleError with the
  /// obstacle's name and X where the shape has none.
  Nearest nearest(const Vector3d& X) const;
};

}  // namespace plastron::obstacle
