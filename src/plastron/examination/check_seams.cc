// Checks for edges that coincide in space, joined or not.
#include <plastron/examination/checks.hpp>
#include <plastron/examination/seams.hpp>

namespace plastron::examination {

void check_seams(Examined& examined) {
  for (const std::string& warning : seam_warnings(*examined.space, *examined.surface))
    examined.add(Severity::warning, "{}", warning);
}

}  // namespace plastron::examination
