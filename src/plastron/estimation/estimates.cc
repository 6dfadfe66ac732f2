#include <plastron/estimation/estimates.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {

double GoalEstimate::difference() const { return at_higher_degree ? *at_higher_degree - value + free_edges : estimate; }

double GoalEstimate::least_error() const {
  constexpr double least_part = 0.2;
  return std::max(least_part * recovered_error(), contact_line);
}

// The rule is based on problems with known solutions (docs/methods/estimates.md).
double GoalEstimate::error() const {
  const double recovered = recovered_error();
  if (!at_higher_degree) return recovered;
  const double seen = std::abs(difference());
  if (seen >= recovered) return seen;
  return std::max(std::cbrt(recovered * seen * seen), least_error());
}

}  // namespace plastron::estimation
