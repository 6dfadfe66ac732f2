// Supports and loads name boundaries, probes name points: they must be there.
#include <plastron/examination/checks.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace plastron::examination {

void check_names(Examined& examined) {
  const auto& known = examined.space->coarse->boundaries;
  const auto check = [&](const std::string& name, const char* what) {
    if (std::ranges::find(known, name) == known.end())
      examined.add(Severity::error, "{} names the boundary \"{}\", which the mesh does not have; it has: {}", what,
                   name, fmt::join(known, ", "));
  };
  for (const auto& s : examined.problem.supports) check(s.boundary, "a support");
  for (const auto& l : examined.problem.edge_loads) check(l.boundary, "a load");
}

void check_probes(Examined& examined) {
  for (const computation::Probe& p : examined.problem.probes)
    if (!fem::locate(*examined.space->coarse, p.at))
      examined.add(Severity::error, "the probe \"{}\" at ({:g}, {:g}) lies outside of the domain", p.name, p.at[0],
                   p.at[1]);
}

}  // namespace plastron::examination
