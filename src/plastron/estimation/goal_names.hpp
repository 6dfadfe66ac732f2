// The names of the numbers of results.json whose errors can be estimated: "energy", "reaction", "contact_area",
// "stress", "probe.NAME.u.z", "support.NAME.force.x", "obstacle.NAME.force", ...
#pragma once
#include <plastron/estimation/functionals.hpp>

#include <string>
#include <vector>

namespace plastron::estimation {

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
