// Rigid motions that the supports leave free: nothing resists some, the obstacle may hold others if the loads press the
// shell onto it, which is decided here.
#include <plastron/assembly/load_vector.hpp>
#include <plastron/examination/checks.hpp>
#include <plastron/examination/pressing.hpp>

namespace plastron::examination {

namespace {

algebra::Vector load_of(const Examined& examined) {
  const computation::Problem& problem = examined.problem;
  constexpr bool tying = false, is_covariant = false;  // the work on rigid motions, which are Cartesian fields
  const assembly::ShellOperator shell(examined.space, examined.surface, problem.sections, tying, is_covariant);
  return assembly::load_vector(shell, problem.area_loads, problem.edge_loads, problem.gravity);
}

void add_hold(const Pressing& pressing, const RigidMotions& motions, Examined& examined) {
  const std::string motion = motions.in_words(pressing.motion);
  if (pressing.hold == Hold::pulled_off)
    examined.add(Severity::error,
                 "nothing stops the shell in the rigid motion: {}; the supports leave it free, it opens the gap, and "
                 "the loads drive it on; turn the loads so that they press the shell onto the obstacle, or fix more "
                 "components",
                 motion);
  if (pressing.hold == Hold::balanced)
    examined.add(Severity::warning,
                 "the loads do not press the shell onto the obstacle against the rigid motion: {}; they do no work or "
                 "hardly any against it, so the solution need not be unique; press the shell onto the obstacle, or "
                 "fix more components",
                 motion);
}

}  // namespace

void check_rigid_motions(Examined& examined, const ExaminedNodes& nodes) {
  const RigidMotions motions(nodes.points);
  const FreeMotions free = free_rigid_motions(motions, nodes.points, nodes.coordinates);
  for (const RigidMotion& motion : readable(free.unheld))
    examined.add(Severity::error,
                 "the supports leave a rigid motion free: {}; fix more components, or say on which boundaries",
                 motions.in_words(motion));
  if (free.held_by_obstacle.cols() > 0) {
    const Pressing found =
        pressing(motions, free.held_by_obstacle, nodes.points, nodes.coordinates, load_of(examined).owned());
    add_hold(found, motions, examined);
    for (const RigidMotion& motion : readable(free.held_by_obstacle))
      examined.add(Severity::note, "only the obstacle holds the rigid motion: {}{}", motions.in_words(motion),
                   found.hold == Hold::pressed ? "; the loads press the shell onto it" : "");
  } else if (free.unheld.cols() + free.held_by_obstacle.cols() == 0) {
    examined.add(Severity::note, "supports: no rigid motion is left free");
  }
}

}  // namespace plastron::examination
