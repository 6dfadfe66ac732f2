// Elements against thickness: where they lock.
#include <plastron/study/checks.hpp>
#include <plastron/study/locking.hpp>

namespace plastron::study {

void check_locking(Examined& examined) {
  for (const std::string& warning : locking_warnings(examined.problem)) examined.add(Severity::warning, "{}", warning);
}

}  // namespace plastron::study
