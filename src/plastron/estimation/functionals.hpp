// The numbers of a result whose error can be estimated, as functionals of the solution.
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

namespace plastron::estimation {

/// 1/2 a(U, U) [J]
struct Energy {};
/// l(U) [J]
struct LoadWork {};
/// A component of the force of one obstacle on the shell, or of all together; without a component its norm [N].
struct ObstacleForce {
  std::optional<std::size_t> obstacle{};
  std::optional<int> component{};
};
/// The same of what supports carry: all of them, or those of one boundary [N].
struct SupportForce {
  std::optional<std::string> boundary{};
  std::optional<int> component{};
};
/// Mid-surface area that touches one obstacle, or the sum over all [m^2].
struct ContactArea {
  std::optional<std::size_t> obstacle{};
};
/// A component of (u, r) at a point of Omega [m], [1].
struct PointDisplacement {
  Eigen::Vector2d at;
  int component = 0;  ///< u_x u_y u_z r_x r_y r_z
};
/// A number that follows from the stress resultants at a point, as probes and fields have them.
enum class StressKind { resultant, lower, middle, upper, von_mises };
struct PointStress {
  Eigen::Vector2d at;
  StressKind kind = StressKind::resultant;
  /// Of resultants N_11 N_22 N_12 [N/m], M likewise [N], Q_1 Q_2 [N/m]; of stresses at a height 11 22 12; none of the largest von Mises stress
  int component = 0;
  std::optional<Eigen::Vector3d> axis{};  ///< that t1 follows
  bool is_smooth = true;                  ///< recovered over patches, not of the point's cell alone
};
/// The largest equivalent stress of von Mises away from singular places [Pa].
struct LargestStress {
  bool is_smooth = true;
};
/// How far its force has pressed an obstacle [m].
struct ObstaclePosition {
  std::size_t obstacle = 0;
};

using Functional = std::variant<Energy, LoadWork, ObstacleForce, SupportForce, ContactArea, PointDisplacement,
                                PointStress, LargestStress, ObstaclePosition>;

/// Of its value.
std::string unit_of(const Functional& functional);

/// A number that is asked for, by its name.
struct Goal {
  std::string name;
  Functional functional;
  std::optional<double> tolerance{};  ///< relative, where it is asked for to an accuracy
};

}  // namespace plastron::estimation
