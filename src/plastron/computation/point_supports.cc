#include <plastron/computation/point_supports.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace plastron::computation {

namespace {

/// Limit below which a force counts as zero, relative to the sum of the norms of all loads.
constexpr double negligible_force = 1e-6;

/// Whether there are six components, all at points: then statics alone determines their forces.
bool is_isostatic(const std::vector<assembly::Support>& supports) {
  std::size_t components = 0;
  for (const assembly::Support& support : supports) {
    if (!support.point) return false;
    components += support.components.size();
  }
  return components == 6;
}

/// Whether loads and the obstacle's reaction balance without the supports.
bool in_equilibrium(const solution::Summary& s) {
  solution::Wrench sum = s.loads;
  sum += s.reaction;
  sum.move_point(-s.moment_point);  // back to the origin
  const double force = sum.force.norm(), moment = sum.moment.norm();
  return force <= negligible_force * s.load_norms && moment <= negligible_force * s.load_norms * s.size;
}

}  // namespace

std::vector<std::string> point_support_warnings(const Result& result, const std::vector<assembly::Support>& supports) {
  const solution::Summary& s = result.summary;
  if (s.point_reactions.empty() || s.is_unstrained) return {};
  const auto most = std::ranges::max_element(
      s.point_reactions, {}, [](const solution::PointReaction& reaction) { return reaction.force.norm(); });
  const double force = most->force.norm();
  double pressed = 0;  // force of obstacles, which may be the only load of the shell
  for (const solution::ObstacleContact& contact : s.obstacles) pressed += contact.reaction.force.norm();
  if (force <= negligible_force * (s.load_norms + pressed)) return {};
  const std::string what =
      fmt::format("the support at the point ({:.6g}, {:.6g}) carries {:.4g} N", most->at[0], most->at[1], force);
  if (is_isostatic(supports) && in_equilibrium(s))
    return {what + fmt::format(", {:.1g} of the loads, though these are in equilibrium: on a curved shell the mesh "
                               "misses so much of a rigid rotation; refine it or raise the degree",
                               force / s.load_norms)};
  return {
      what +
      ": a force at a point is singular in this model, the displacement under it grows without limit as the mesh is "
      "refined; let the loads be in equilibrium, so that points hold the rigid motions alone, or support a boundary"};
}

}  // namespace plastron::computation
