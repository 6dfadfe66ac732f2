// The numbers of results.json whose errors can be estimated, by name: "energy", "reaction", "contact_area", "stress", "probe.NAME.u.z",
// "support.NAME.force.x", "obstacle.NAME.force", ...
#pragma once
#include <plastron/estimation/functionals.hpp>

#include <string>
#include <vector>

namespace plastron::estimation {

/// What a problem has that can be asked for.
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
  std::vector<Body> obstacles{};          ///< in the problem's order
  std::optional<Eigen::Vector3d> axis{};  ///< of resultants at probes
  bool is_smooth = true;                  ///< resultants are recovered over patches
};

/// All that can be asked for, in the order in which results.json has them.
std::vector<Goal> all_goals(const Catalogue& catalogue);
/// The one of this name; empty if there is none.
std::optional<Goal> find_goal(const std::string& name, const Catalogue& catalogue);

}  // namespace plastron::estimation
