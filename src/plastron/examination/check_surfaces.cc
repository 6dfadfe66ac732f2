// Reports the changes that reading has made to the surfaces of obstacles.
#include <plastron/examination/checks.hpp>

namespace plastron::examination {

void check_surfaces(Examined& examined) {
  for (std::size_t k = 0; k < examined.problem.shell.obstacles.all.size(); ++k) {
    const auto* surface = std::get_if<obstacle::TriangleSurface>(&examined.problem.shell.obstacles.all[k].shape);
    if (!surface || surface->mesh().joined == 0) continue;
    examined.add(
        Severity::note,
        "surface of {}: {} corners at open sides were joined with others up to {:.2g} m away (allowed: {:g} of "
        "the surface's size)",
        obstacle_text(examined.problem, k), surface->mesh().joined, surface->mesh().joined_over,
        obstacle::joining_tolerance);
  }
}

}  // namespace plastron::examination
