// Elements and thickness: where elements without tying lock, and where rounding hides the solution.
#include <plastron/study/cell_sizes.hpp>
#include <plastron/study/checks.hpp>
#include <plastron/study/locking.hpp>

#include <algorithm>
#include <limits>

namespace plastron::study {

void check_locking(Examined& examined) {
  for (const std::string& warning : locking_warnings(examined.problem)) examined.add(Severity::warning, "{}", warning);
}

double rounding_residual(const Problem& problem) {
  // Membrane strains of a bending are differences of displacements: rounding eps w over the distance h of nodes, as
  // energy e (eps w / h)^2, works against the bending energy e^3 (w / L^2)^2. Factor measured on the inclined strip at
  // e / L = 0.02 to 2e-6, degrees 2 and 3, 48 to 256 intervals: within 3 of what the certificate found.
  constexpr double factor = 0.04;
  const CellSizes sizes = cell_sizes(problem);
  double worst = 0;
  for (const auto& [h, e] : sizes.cells) {
    const double distance = h / problem.discretisation.degree;
    worst = std::max(worst, sizes.extent / e * (sizes.extent / distance));
  }
  return factor * std::numeric_limits<double>::epsilon() * worst * worst;
}

void check_precision(Examined& examined) {
  constexpr double poor = 5e-7;  // half of what the certificate lets pass
  const double residual = rounding_residual(examined.problem);
  if (residual < poor) return;
  examined.add(Severity::warning,
               "the shell is very thin for double precision on the finest mesh: where it bends, rounding alone leaves "
               "about {:.1g} of the loads unbalanced, and the certificate may call the result inaccurate; take fewer "
               "refinements, a lower degree or a thicker shell",
               residual);
}

}  // namespace plastron::study
