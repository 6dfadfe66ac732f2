#include <plastron/solution/summary.hpp>

namespace plastron::solution {

void take_moments_about(const Vector3d& point, Summary& summary) {
  const Vector3d by = point - summary.moment_point;
  for (Wrench* wrench : {&summary.loads, &summary.reaction, &summary.support_reaction}) wrench->move_point(by);
  for (SupportReaction& support : summary.support_reactions) support.reaction.move_point(by);
  for (CornerReaction& corner : summary.corner_reactions) corner.reaction.move_point(by);
  for (ObstacleContact& obstacle : summary.obstacles) {
    obstacle.reaction.move_point(by);
    for (ContactZone& zone : obstacle.zones) zone.reaction.move_point(by);
  }
  summary.moment_point = point;
}

}  // namespace plastron::solution
