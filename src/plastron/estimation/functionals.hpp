// Functionals of the solution whose error can be estimated, and their names in results.json: "energy", "reaction",
// "contact_area", "stress", "probe.NAME.u.z", "support.NAME.force.x", "obstacle.NAME.force", ...
#pragma once
#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace plastron::estimation {

/// 1/2 a(U, U) [J]
struct Energy {};
/// l(U) [J]
struct LoadWork {};
/// A component of the force of one obstacle, or of all together, on the shell; without a component its norm [N].
struct ObstacleForce {
  std::optional<std::size_t> obstacle{};
  std::optional<int> component{};
};
/// A component of the force of all supports, or of one boundary's supports; without a component its norm [N].
struct SupportForce {
  std::optional<std::string> boundary{};
  std::optional<int> component{};
};
/// Mid-surface area in contact with one obstacle, or the sum over all [m^2].
struct ContactArea {
  std::optional<std::size_t> obstacle{};
};
/// A component of (u, r) at a point of Omega [m], [rad].
struct PointDisplacement {
  Eigen::Vector2d at;
  int component = 0;  ///< u_x u_y u_z r_x r_y r_z
};
/// A number computed from the stress resultants at a point, as in probes and fields.
enum class StressKind { resultant, lower, middle, upper, von_mises };
struct PointStress {
  Eigen::Vector2d at;
  StressKind kind = StressKind::resultant;
  /// Component of the kind. Resultants: N_11 N_22 N_12 [N/m], M_11 M_22 M_12 [N], Q_1 Q_2 [N/m]. Stresses at a
  /// height: 11 22 12. Unused for the largest von Mises stress.
  int component = 0;
  std::optional<Eigen::Vector3d> axis{};  ///< direction of t1
  bool is_smooth = true;                  ///< recovered over patches, not from the point's cell alone
};
/// The largest equivalent stress of von Mises away from singular places [Pa].
struct LargestStress {
  bool is_smooth = true;
};
/// Displacement of a pressed obstacle by its force [m].
struct ObstaclePosition {
  std::size_t obstacle = 0;
};

using Functional = std::variant<Energy, LoadWork, ObstacleForce, SupportForce, ContactArea, PointDisplacement,
                                PointStress, LargestStress, ObstaclePosition>;

/// The unit of the functional's value.
std::string unit_of(const Functional& functional);

/// A named number whose error is estimated.
struct Goal {
  std::string name;
  Functional functional;
  std::optional<double> tolerance{};  ///< relative tolerance, if an accuracy is required
};

/// Parts of a problem from which goals are made.
struct Catalogue {
  struct Point {
    std::string name;
    Eigen::Vector2d at;
  };
  struct Body {
    std::string name;
    bool is_pressed = false;
  };
  std::vector<Point> probes{};
  std::vector<std::string> supports{};    ///< boundaries
  std::vector<Body> obstacles{};          ///< in the order of the problem
  std::optional<Eigen::Vector3d> axis{};  ///< axis of resultants at probes
  bool is_smooth = true;                  ///< resultants are recovered over patches
};

/// Returns all goals in the order of results.json.
std::vector<Goal> all_goals(const Catalogue& catalogue);
/// Returns the goal with this name; empty if there is none.
std::optional<Goal> find_goal(const std::string& name, const Catalogue& catalogue);

}  // namespace plastron::estimation
