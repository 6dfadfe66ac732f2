// Edges that coincide in space, joined or not.
#include <plastron/study/checks.hpp>
#include <plastron/study/seams.hpp>

namespace plastron::study {

void check_seams(Examined& examined) {
  for (const std::string& warning : seam_warnings(*examined.space, *examined.surface))
    examined.add(Severity::warning, "{}", warning);
}

}  // namespace plastron::study
