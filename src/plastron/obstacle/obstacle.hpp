// A rigid obstacle as a value: a shape in space, how it moves from step to step, and the face of the shell that it meets.
#pragma once
#include <plastron/obstacle/ball.hpp>
#include <plastron/obstacle/half_space.hpp>

#include <string>
#include <variant>

namespace plastron::obstacle {

/// A face of the shell: the points phi -+ e/2 a_3. Nearer is, point by point, the one whose outward normal looks at the obstacle.
enum class Face { lower, upper, nearer };

using Shape = std::variant<HalfSpace, Ball>;

struct Obstacle {
  std::string name{};  ///< no two obstacles of a problem share one; may be empty where there is one obstacle only
  Shape shape = HalfSpace{};
  Face face = Face::lower;                  ///< of the shell, the one that may touch
  Vector3d translation = Vector3d::Zero();  ///< of the whole body from time 0 to time 1 [m]

  /// Its gap is linear in the displacements: nothing is to be linearised again.
  bool is_plane() const { return std::holds_alternative<HalfSpace>(shape); }
  /// Distance, normal and curvature at X when the body stands where it does at `time`, which runs linearly through the steps.
  Nearest nearest(const Vector3d& X, double time) const {
    const Vector3d at_rest = X - time * translation;
    return std::visit([&](const auto& body) { return body.nearest(at_rest); }, shape);
  }
};

}  // namespace plastron::obstacle
