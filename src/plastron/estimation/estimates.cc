#include <plastron/estimation/estimates.hpp>

#include <algorithm>
#include <cmath>

namespace plastron::estimation {

double GoalEstimate::difference() const { return at_higher_degree ? *at_higher_degree - value + free_edges : estimate; }

double GoalEstimate::least_error() const {
  constexpr double least_part = 0.2, least_part_of_edge = 0.4;
  return std::max({least_part * recovered_error(), least_part_of_edge * contact_edge, contact_line});
}

// The rule is based on problems with known solutions (docs/methods/estimates.md).
double GoalEstimate::error() const {
  const double recovered = recovered_error();
  if (!at_higher_degree) return recovered;
  // One degree more shows a third of the error of a kink inside of a cell.
  constexpr double kink_over_change = 3.2;
  const double seen = (has_kinks ? kink_over_change : 1) * std::abs(difference());
  if (seen >= recovered) return seen;
  // The place of a contact zone's edge is known to the square of the distance of nodes, which one degree more reduces by a third.
  constexpr double edge_over_change = 2.8;
  const double whole = std::min(seen * (1 + (edge_over_change - 1) * contact_edge / recovered), recovered);
  return std::max(std::cbrt(recovered * whole * whole), least_error());
}

}  // namespace plastron::estimation
