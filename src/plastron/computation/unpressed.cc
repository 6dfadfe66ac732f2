#include <plastron/computation/unpressed.hpp>

#include <plastron/algebra/agreement.hpp>
#include <plastron/certificate/gap_between.hpp>
#include <plastron/obstacle/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plastron::computation {

namespace {

/// Returns the least gap to each obstacle, also between nodes (collective) [m].
std::vector<double> least_gaps(const assembly::DiscreteShell& discrete, const algebra::Vector& y) {
  const MPI_Comm comm = discrete.space().layout->comm;
  std::vector<double> least(discrete.obstacles.all.size(), std::numeric_limits<double>::infinity());
  const auto cells =
      algebra::in_agreement<obstacle::ObstacleError>(comm, [&] { return certificate::searched_gaps(discrete, y); });
  for (const certificate::CellGap& cell : cells) least[cell.obstacle] = std::min(least[cell.obstacle], cell.gap);
  for (double& gap : least) gap = algebra::min_over_ranks(gap, comm);
  return least;
}

double largest_thickness(const assembly::DiscreteShell& discrete) {
  double most = 0;
  for (const assembly::NodalPoint& point : discrete.points) most = std::max(most, point.thickness);
  return algebra::max_over_ranks(most, discrete.space().layout->comm);
}

}  // namespace

std::vector<std::size_t> unpressed_obstacles(const assembly::DiscreteShell& discrete) {
  std::vector<std::size_t> unpressed;
  for (std::size_t k = 0; k < discrete.obstacles_at_start.all.size(); ++k)
    if (discrete.obstacles_at_start.all[k].is_pressed() && discrete.state.factors.force(k) == 0) unpressed.push_back(k);
  return unpressed;
}

void release(assembly::DiscreteShell& discrete, const std::vector<std::size_t>& unpressed) {
  constexpr double far = 1e3;  // times all lengths of the problem
  assembly::State state = discrete.state;
  state.positions = discrete.positions();
  if (!state.is_admissible()) state.lifts = algebra::Vector(discrete.space().layout, discrete.obstacle_block());
  for (std::size_t i = 0; i < discrete.points.size(); ++i)
    for (const std::size_t k : unpressed)
      state.lifts.at(i)[k] = -far * (discrete.points[i].thickness + discrete.points[i].phi.norm() +
                                     std::abs(discrete.coordinates.gaps[k][i].initial));
  linearise(discrete, std::move(state));
}

void put_back(assembly::DiscreteShell& discrete, const std::vector<std::size_t>& unpressed, const algebra::Vector& y) {
  constexpr int most_moves = 100;
  constexpr double margin = 1e-9;  // of the thickness
  const double thickness = largest_thickness(discrete);
  assembly::State state = discrete.state;
  state.positions = discrete.positions();
  state.lifts = {};
  linearise(discrete, state);
  // An obstacle moves back by its depth as long as it has one.
  for (int move = 0; move < most_moves && !discrete.obstacles.are_linear; ++move) {
    const std::vector<double> least = least_gaps(discrete, y);
    bool is_free = true;
    for (const std::size_t k : unpressed)
      if (least[k] < 0) {
        state.positions[k] -= margin * thickness - least[k];
        is_free = false;
      }
    if (is_free) break;
    linearise(discrete, state);
  }
}

}  // namespace plastron::computation
