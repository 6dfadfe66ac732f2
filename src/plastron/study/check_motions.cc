// Rigid motions that the supports leave free.
#include <plastron/study/checks.hpp>
#include <plastron/study/rigid_motions.hpp>

namespace plastron::study {

void check_rigid_motions(Examined& examined, const ExaminedNodes& nodes) {
  const FreeMotions free = free_rigid_motions(nodes.points, nodes.coordinates);
  for (const std::string& motion : free.unheld)
    examined.add(Severity::error,
                 "the supports leave a rigid motion free: {}; fix more components, or say on which boundaries", motion);
  for (const std::string& motion : free.held_by_obstacle)
    examined.add(Severity::warning,
                 "only the obstacle can hold the rigid motion: {}; the problem is singular unless the loads press the "
                 "shell onto it",
                 motion);
  if (free.unheld.empty() && free.held_by_obstacle.empty())
    examined.add(Severity::note, "supports: no rigid motion is left free");
}

}  // namespace plastron::study
