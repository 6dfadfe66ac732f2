#include <plastron/meshing/marks.hpp>

#include <plastron/algebra/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::meshing {

std::vector<double> error_indicators(const fem::Space& space, const std::vector<estimation::GoalRecord>& records,
                                     const estimation::Estimates& estimates) {
  std::vector<double> all(space.owned_cells, 0.0);
  for (std::size_t g = 0; g < records.size(); ++g) {
    const std::vector<double>& cells = estimates.goals[g].cells;
    for (std::size_t c = 0; c < cells.size(); ++c) all[c] = std::max(all[c], std::abs(cells[c]) / records[g].allowed());
  }
  return all;
}

double error_threshold(const std::vector<double>& indicators, double share, MPI_Comm comm) {
  double sum = 0, most = 0;
  for (const double x : indicators) {
    sum += x;
    most = std::max(most, x);
  }
  const double whole = algebra::sum_over_ranks(sum, comm);
  double at = algebra::max_over_ranks(most, comm);
  if (!(whole > 0)) return std::numeric_limits<double>::infinity();
  constexpr double step = 0.97;
  for (double part = 0; part < share * whole;) {
    at *= step;
    double mine = 0;
    for (const double x : indicators)
      if (x > at) mine += x;
    part = algebra::sum_over_ranks(mine, comm);
  }
  return at;
}

std::vector<signed char> marks(const fem::Space& space, const std::vector<estimation::GoalRecord>& goals,
                               const estimation::Estimates& estimates, double share) {
  const std::vector<double> weights = error_indicators(space, goals, estimates);
  const double above = error_threshold(weights, share, space.layout->comm);
  // A cell made of four has about 2^(2k + 2) times their error. This must still be negligible.
  const double below = 0.01 * above * std::exp2(-2 * space.degree - 2);
  std::vector<signed char> result;
  result.reserve(weights.size());
  for (const double x : weights) result.push_back(x > above ? 1 : x < below ? -1 : 0);
  for (const std::size_t cell : estimates.unjudged) result[cell] = 1;
  return result;
}

}  // namespace plastron::meshing
