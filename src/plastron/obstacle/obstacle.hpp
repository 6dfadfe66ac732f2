// A rigid obstacle as a value: a shape in space, its motion in steps or its pressing force, and the face of the shell
// that it touches.
#pragma once
#include <plastron/obstacle/bed.hpp>
#include <plastron/obstacle/distance_field.hpp>
#include <plastron/obstacle/height_field.hpp>
#include <plastron/obstacle/motion.hpp>
#include <plastron/obstacle/shapes.hpp>
#include <plastron/obstacle/triangle_surface.hpp>

#include <span>
#include <string>
#include <variant>

namespace plastron::obstacle {

/// A face of the shell: the points phi -+ e/2 a_3. `nearer` is at each point the face whose outward normal points to
/// the obstacle.
enum class Face { lower, upper, nearer };

/// Copies are cheap: large data are shared and constant.
using Shape = std::variant<HalfSpace, Ball, Cylinder, Box, Torus, Cone, HeightField, DistanceField, TriangleSurface>;

struct Obstacle {
  std::string name{};  ///< unique among the obstacles of a problem; may be empty for a single obstacle
  Shape shape = HalfSpace{};
  Face face = Face::nearer;  ///< face of the shell that may touch
  /// Another obstacle is the same body for the other face; one of them may be far away.
  bool is_for_both = false;
  Placement placement{};          ///< placement of the shape, at time 0 if it moves
  std::vector<Motion> motions{};  ///< one per step
  /// Force that presses the obstacle along its direction; other directions are fixed [N].
  Vector3d force = Vector3d::Zero();
  Bed bed{};  ///< by which its surface gives

  bool has_bed() const { return !bed.is_rigid(); }
  /// Whether its gap is linear in the displacements; then no further linearisation is necessary.
  bool is_plane() const { return std::holds_alternative<HalfSpace>(shape); }
  /// Whether smooth faces of the shell can lie on sharp edges or corners of its surface.
  bool has_edges() const;
  /// Whether a force presses it; then its displacement along the force is an unknown.
  bool is_pressed() const { return !force.isZero(0); }
  /// Returns the same body at rest in its placement at `time`, displaced by `position` [m] along its force.
  Obstacle standing(double time, double position = 0) const;
  /// Returns "the obstacle", with its name if it has one.
  std::string text() const;
  /// Distance, normal and curvature at X for the placed shape. Throws ObstacleError with the obstacle's name and X if
  /// the shape has none there.
  Nearest nearest(const Vector3d& X) const;
  /// Whether the distance needs a search that is faster for many points together.
  bool is_searched() const { return std::holds_alternative<DistanceField>(shape); }
  /// Prepares nearest() at many points. Does nothing for shapes that are not searched.
  void prepare(std::span<const Vector3d> X) const;
};

}  // namespace plastron::obstacle
