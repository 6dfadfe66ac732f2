// The contact zones of a finished result.
#pragma once
#include <plastron/certificate/contact_zones.hpp>
#include <plastron/computation/result.hpp>

namespace plastron::computation {

/// Of each obstacle of the solution, into the summary (collective).
inline void add_contact_zones(Result& result) {
  auto zones = certificate::contact_zones(*result.solution->discrete, result.solution->nodal);
  for (std::size_t k = 0; k < zones.size(); ++k) {
    for (certificate::ContactZone& zone : zones[k]) zone.reaction.move_point(result.summary.moment_point);
    result.summary.obstacles[k].zones = std::move(zones[k]);
  }
}

}  // namespace plastron::computation
